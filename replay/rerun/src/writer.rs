//! The writer: a queue, a thread that encodes and writes, and the first failure kept for everyone.
//!
//! The file is opened under its final name and every message goes to the operating system whole and
//! at once, so that a killed process leaves all that was sent before readable. A message that could
//! be written in part only (disk full) is cut off again.

use std::fs::File;
use std::io::Write;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use re_chunk::{Chunk, RowId};
use re_log_encoding::{CrateVersion, Encoder, EncodingOptions};
use re_log_types::{ApplicationId, EntityPath, LogMsg, SetStoreInfo, StoreId, TimePoint};
use re_sdk_types::archetypes::RecordingInfo;

use crate::blueprint::Layout;
use crate::columns::OwnedChunk;
use crate::failure::{Code, Failure, panic_text};

/// A caller waits while more than this is queued [bytes]: some seconds of a large scene, and little
/// beside the memory of a machine that runs one.
const MOST_BYTES_WAITING: u64 = 256 << 20;

enum Job {
    Chunk(OwnedChunk),
    Message(Box<LogMsg>),
    Flush {
        durable: bool,
        done: Sender<Result<(), Failure>>,
    },
    Close {
        done: Sender<Result<(), Failure>>,
    },
}

#[derive(Default)]
struct Waiting {
    bytes: u64,
    failure: Option<Failure>,
}

#[derive(Default)]
struct Shared {
    waiting: Mutex<Waiting>,
    less_waiting: Condvar,
    written: AtomicU64,
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Waiting> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn fail(&self, failure: Failure) {
        self.lock().failure.get_or_insert(failure);
        self.less_waiting.notify_all();
    }

    fn result(&self) -> Result<(), Failure> {
        self.lock().failure.clone().map_or(Ok(()), Err)
    }
}

pub struct Writer {
    path: String,
    store: StoreId,
    jobs: Sender<Job>,
    shared: Arc<Shared>,
}

impl Writer {
    pub fn open(path: &str, application_id: &str, name: &str) -> Result<Self, Failure> {
        let failed = |doing: &str, error: &dyn std::fmt::Display| {
            Failure::new(Code::Io, format!("cannot {doing} {path}: {error}"))
        };
        let file = File::create(path).map_err(|e| failed("create", &e))?;
        let handle = file.try_clone().map_err(|e| failed("open", &e))?;
        let shared = Arc::new(Shared::default());
        let counted = CountedFile {
            file,
            shared: shared.clone(),
        };
        let options = EncodingOptions::PROTOBUF_COMPRESSED;
        let encoder = Encoder::new_eager(CrateVersion::LOCAL, options, counted)
            .map_err(|e| failed("write", &e))?;

        let application_id = ApplicationId::try_new(application_id)
            .map_err(|e| Failure::argument(format!("application_id: {e}")))?;
        let info = re_sdk::new_store_info(application_id);
        let store = info.store_id.clone();
        let (jobs, queue) = channel();
        let mut thread = WriterThread {
            path: path.to_owned(),
            store: store.clone(),
            encoder,
            handle,
            shared: shared.clone(),
            whole_bytes: shared.written.load(Ordering::Relaxed),
        };
        std::thread::Builder::new()
            .name("plumb_recorder".into())
            .spawn(move || thread.run(&queue))
            .map_err(|e| failed("start a thread to write", &e))?;

        let writer = Self {
            path: path.to_owned(),
            store,
            jobs,
            shared,
        };
        writer.post(LogMsg::SetStoreInfo(SetStoreInfo {
            row_id: *RowId::new(),
            info,
        }))?;
        writer.post_properties(name)?;
        Ok(writer)
    }

    fn post_properties(&self, name: &str) -> Result<(), Failure> {
        let properties = RecordingInfo::new().with_name(name);
        let chunk = Chunk::builder(EntityPath::properties())
            .with_archetype(RowId::new(), TimePoint::default(), &properties)
            .build()
            .and_then(|chunk| chunk.to_arrow_msg())
            .map_err(|e| Failure::new(Code::BadArgument, e.to_string()))?;
        self.post(LogMsg::ArrowMsg(self.store.clone(), chunk))
    }

    fn post(&self, message: LogMsg) -> Result<(), Failure> {
        self.enqueue(Job::Message(Box::new(message)))
    }

    fn enqueue(&self, job: Job) -> Result<(), Failure> {
        self.jobs.send(job).map_err(|_| {
            self.shared.result().err().unwrap_or_else(|| {
                Failure::new(
                    Code::Io,
                    format!("the thread that writes {} is gone", self.path),
                )
            })
        })
    }

    /// The first failure of the writer thread, if any.
    pub fn check(&self) -> Result<(), Failure> {
        self.shared.result()
    }

    pub fn send(&self, chunk: OwnedChunk) -> Result<(), Failure> {
        let mut waiting = self.shared.lock();
        while waiting.failure.is_none() && waiting.bytes > MOST_BYTES_WAITING {
            waiting = self
                .shared
                .less_waiting
                .wait(waiting)
                .unwrap_or_else(PoisonError::into_inner);
        }
        if let Some(failure) = &waiting.failure {
            return Err(failure.clone());
        }
        waiting.bytes += chunk.bytes as u64;
        drop(waiting);
        self.enqueue(Job::Chunk(chunk))
    }

    pub fn send_layout(&self, layout: &Layout) -> Result<(), Failure> {
        for message in layout.messages(self.store.application_id().clone())? {
            self.post(message)?;
        }
        self.check()
    }

    pub fn flush(&self, timeout: Duration, durable: bool) -> Result<(), Failure> {
        let (done, answer) = channel();
        self.enqueue(Job::Flush { durable, done })?;
        self.answer(&answer, timeout)
    }

    pub fn close(self, timeout: Duration) -> Result<(), Failure> {
        let (done, answer) = channel();
        self.enqueue(Job::Close { done })?;
        self.answer(&answer, timeout)
    }

    fn answer(
        &self,
        answer: &Receiver<Result<(), Failure>>,
        timeout: Duration,
    ) -> Result<(), Failure> {
        match answer.recv_timeout(timeout) {
            Ok(result) => result,
            Err(RecvTimeoutError::Disconnected) => self.check(),
            Err(RecvTimeoutError::Timeout) => Err(Failure::new(
                Code::Timeout,
                format!("{} was not written within {timeout:?}", self.path),
            )),
        }
    }

    pub fn bytes_written(&self) -> u64 {
        self.shared.written.load(Ordering::Relaxed)
    }
}

/// Counts what the operating system took.
struct CountedFile {
    file: File,
    shared: Arc<Shared>,
}

impl Write for CountedFile {
    fn write(&mut self, buffer: &[u8]) -> std::io::Result<usize> {
        let taken = self.file.write(buffer)?;
        self.shared
            .written
            .fetch_add(taken as u64, Ordering::Relaxed);
        Ok(taken)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.file.flush()
    }
}

struct WriterThread {
    path: String,
    store: StoreId,
    encoder: Encoder<CountedFile>,
    handle: File,
    shared: Arc<Shared>,
    /// Of messages that were written to their end.
    whole_bytes: u64,
}

impl WriterThread {
    fn run(&mut self, queue: &Receiver<Job>) {
        while let Ok(job) = queue.recv() {
            let work = std::panic::AssertUnwindSafe(|| self.work(job));
            match std::panic::catch_unwind(work) {
                Ok(true) => {}
                Ok(false) => return,
                Err(panic) => self.fail(Failure::new(Code::Panic, panic_text(panic.as_ref()))),
            }
        }
    }

    /// False when there is nothing more to come.
    fn work(&mut self, job: Job) -> bool {
        match job {
            Job::Chunk(chunk) => {
                self.shared.lock().bytes -= chunk.bytes as u64;
                self.shared.less_waiting.notify_all();
                if self.shared.result().is_ok() {
                    let message = chunk.into_chunk().and_then(|chunk| {
                        chunk
                            .to_arrow_msg()
                            .map_err(|e| Failure::argument(e.to_string()))
                    });
                    match message {
                        Ok(message) => self.append(&LogMsg::ArrowMsg(self.store.clone(), message)),
                        Err(failure) => self.fail(failure),
                    }
                }
                true
            }
            Job::Message(message) => {
                if self.shared.result().is_ok() {
                    self.append(&message);
                }
                true
            }
            Job::Flush { durable, done } => {
                if self.shared.result().is_ok() {
                    let flushed = self.encoder.flush_blocking().map_err(|e| self.io(&e));
                    let synced = flushed.and_then(|()| {
                        if durable {
                            self.handle.sync_data().map_err(|e| self.io(&e))
                        } else {
                            Ok(())
                        }
                    });
                    if let Err(failure) = synced {
                        self.fail(failure);
                    }
                }
                done.send(self.shared.result()).ok();
                true
            }
            Job::Close { done } => {
                if self.shared.result().is_ok() {
                    if let Err(error) = self.encoder.finish() {
                        let failure = self.io(&error);
                        self.fail(failure);
                    }
                }
                done.send(self.shared.result()).ok();
                false
            }
        }
    }

    fn append(&mut self, message: &LogMsg) {
        match self.encoder.append(message) {
            Ok(_) => self.whole_bytes = self.shared.written.load(Ordering::Relaxed),
            Err(error) => {
                let failure = self.io(&error);
                self.fail(failure);
            }
        }
    }

    fn io(&self, error: &dyn std::fmt::Display) -> Failure {
        Failure::new(Code::Io, format!("writing {}: {error}", self.path))
    }

    /// Keeps the reason, and what was written whole: no half message, no footer that promises more.
    fn fail(&mut self, failure: Failure) {
        self.encoder.do_not_emit_footer();
        self.handle.set_len(self.whole_bytes).ok();
        self.shared.fail(failure);
    }
}
