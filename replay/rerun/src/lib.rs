//! Plumb's bridge to the Rerun SDK: the C functions of `plumb_rerun.h`, and nothing else here.
//!
//! Rerun's own code makes the chunks, encodes, compresses, decodes and lays out the views. Ours is
//! the writer thread around it (`writer.rs`), because a simulation must neither hang on a full disk
//! nor lose the reason, and the walk over the file (`reader.rs`), because a cut tail must be told
//! apart from an end.

mod arrow_payload;
mod blueprint;
mod columns;
mod components;
mod failure;
mod reader;
mod writer;

use std::ffi::{c_char, c_int, c_void};
use std::time::Duration;

use failure::{Failure, guard, text_from};
use writer::Writer;

/// The longest wait that a caller can ask for [s]; what is longer, or not a number, becomes this.
const LONGEST_WAIT_SECONDS: f64 = 3600.0;

fn wait(seconds: f64) -> Duration {
    Duration::from_secs_f64(seconds.clamp(0.0, LONGEST_WAIT_SECONDS).max(0.0))
}

/// # Safety
/// Pointers must be null or valid as `plumb_rerun.h` says; this holds for every function below.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn plumb_rr_open(
    path: *const c_char,
    application_id: *const c_char,
    recording_name: *const c_char,
    error: *mut c_char,
    error_size: usize,
) -> *mut Writer {
    let mut opened = std::ptr::null_mut();
    guard(error, error_size, || {
        let path = unsafe { text_from(path, "path")? };
        let application_id = unsafe { text_from(application_id, "application_id")? };
        let name = unsafe { text_from(recording_name, "recording_name")? };
        opened = Box::into_raw(Box::new(Writer::open(path, application_id, name)?));
        Ok(())
    });
    opened
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn plumb_rr_send_layout(
    writer: *mut Writer,
    layout: *const blueprint::CLayout,
    error: *mut c_char,
    error_size: usize,
) -> c_int {
    guard(error, error_size, || {
        let (writer, layout) = unsafe { (checked(writer)?, checked(layout.cast_mut())?) };
        writer.send_layout(&unsafe { blueprint::Layout::from_c(layout)? })
    })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn plumb_rr_send(
    writer: *mut Writer,
    chunk: *const columns::CChunk,
    error: *mut c_char,
    error_size: usize,
) -> c_int {
    guard(error, error_size, || {
        let (writer, chunk) = unsafe { (checked(writer)?, checked(chunk.cast_mut())?) };
        writer.check()?;
        writer.send(unsafe { columns::OwnedChunk::copy_from(chunk)? })
    })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn plumb_rr_flush(
    writer: *mut Writer,
    timeout_seconds: f64,
    durable: c_int,
    error: *mut c_char,
    error_size: usize,
) -> c_int {
    guard(error, error_size, || {
        unsafe { checked(writer)? }.flush(wait(timeout_seconds), durable != 0)
    })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn plumb_rr_bytes_written(writer: *const Writer) -> u64 {
    match unsafe { writer.as_ref() } {
        Some(writer) => writer.bytes_written(),
        None => 0,
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn plumb_rr_close(
    writer: *mut Writer,
    timeout_seconds: f64,
    error: *mut c_char,
    error_size: usize,
) -> c_int {
    guard(error, error_size, || {
        if writer.is_null() {
            return Err(Failure::argument("the writer is null"));
        }
        let writer = unsafe { Box::from_raw(writer) };
        writer.close(wait(timeout_seconds))
    })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn plumb_rr_read(
    path: *const c_char,
    entity_prefix: *const c_char,
    callback: Option<reader::CCallback>,
    user: *mut c_void,
    summary: *mut reader::CSummary,
    error: *mut c_char,
    error_size: usize,
) -> c_int {
    guard(error, error_size, || {
        let path = unsafe { text_from(path, "path")? };
        let prefix = unsafe { text_from(entity_prefix, "entity_prefix")? };
        let callback = callback.ok_or_else(|| Failure::argument("the callback is null"))?;
        let summary = unsafe { checked(summary)? };
        *summary = reader::CSummary::default();
        reader::read(path, prefix, callback, user, summary)
    })
}

#[unsafe(no_mangle)]
pub extern "C" fn plumb_rr_sdk_version() -> *const c_char {
    c"0.36.3".as_ptr()
}

/// # Safety
/// The pointer must be null or valid for the call, and not used by another thread meanwhile.
unsafe fn checked<'a, T>(pointer: *mut T) -> Result<&'a mut T, Failure> {
    unsafe { pointer.as_mut() }.ok_or_else(|| Failure::argument("a pointer is null"))
}
