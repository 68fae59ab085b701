//! What went wrong, on its way to C: a code and a text. Panics stop here.

use std::ffi::{CStr, c_char, c_int};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Once;

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(i32)]
pub enum Code {
    BadArgument = 1,
    Io = 2,
    Timeout = 3,
    Malformed = 4,
    Stopped = 5,
    Panic = 6,
}

#[derive(Clone, Debug)]
pub struct Failure {
    pub code: Code,
    pub text: String,
}

impl Failure {
    pub fn new(code: Code, text: impl Into<String>) -> Self {
        Self {
            code,
            text: text.into(),
        }
    }

    pub fn argument(text: impl Into<String>) -> Self {
        Self::new(Code::BadArgument, text)
    }
}

/// Runs the body of a C function and turns its failure, or its panic, into a code and a text.
pub fn guard(
    error: *mut c_char,
    error_size: usize,
    body: impl FnOnce() -> Result<(), Failure>,
) -> c_int {
    // What a panic has to say comes back as the error text, and not on the caller's terminal too.
    static QUIET: Once = Once::new();
    QUIET.call_once(|| std::panic::set_hook(Box::new(|_| {})));
    let failure = match catch_unwind(AssertUnwindSafe(body)) {
        Ok(Ok(())) => {
            write_text(error, error_size, "");
            return 0;
        }
        Ok(Err(failure)) => failure,
        Err(panic) => Failure::new(Code::Panic, panic_text(panic.as_ref())),
    };
    write_text(error, error_size, &failure.text);
    failure.code as c_int
}

pub fn panic_text(panic: &(dyn std::any::Any + Send)) -> String {
    format!("a defect in the recording bridge: {}", reason_of(panic))
}

/// What a panic says about itself.
pub fn reason_of(panic: &(dyn std::any::Any + Send)) -> &str {
    panic
        .downcast_ref::<String>()
        .map(String::as_str)
        .or_else(|| panic.downcast_ref::<&str>().copied())
        .unwrap_or("no reason given")
}

/// Zero-terminated, cut at a character's border where it does not fit.
fn write_text(target: *mut c_char, size: usize, text: &str) {
    if target.is_null() || size == 0 {
        return;
    }
    let mut end = text.len().min(size - 1);
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    unsafe {
        std::ptr::copy_nonoverlapping(text.as_ptr(), target.cast::<u8>(), end);
        target.add(end).write(0);
    }
}

/// # Safety
/// Null, or a zero-terminated string that outlives the result.
pub unsafe fn text_from<'a>(pointer: *const c_char, name: &str) -> Result<&'a str, Failure> {
    if pointer.is_null() {
        return Err(Failure::argument(format!("{name} is null")));
    }
    unsafe { CStr::from_ptr(pointer) }
        .to_str()
        .map_err(|_| Failure::argument(format!("{name} is not UTF-8")))
}
