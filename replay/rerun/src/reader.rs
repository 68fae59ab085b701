//! Reading a recording from begin to end, one component of one row at a time.
//!
//! The file is walked twice: first over the frames alone, which tells an end from a cut tail (the
//! SDK's decoder stops at either without a word), then through the decoder, over whole frames only.

use std::ffi::{CString, c_char, c_int, c_void};
use std::fs::File;
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom};
use std::panic::{AssertUnwindSafe, catch_unwind};

use arrow::array::{
    Array, ArrayRef, ArrowPrimitiveType, FixedSizeListArray, ListArray, PrimitiveArray, StringArray,
};
use arrow::datatypes::{DataType, Float32Type, Float64Type, UInt8Type, UInt32Type, UInt64Type};
use re_chunk::Chunk;
use re_log_encoding::{
    CachingApplicationIdInjector, Decodable, DecoderTransport, MessageHeader, MessageKind,
    StreamFooter, StreamHeader, ToApplication,
};
use re_log_types::{EntityPath, LogMsg};
use re_protos::log_msg::v1alpha1::log_msg::Msg;

use crate::arrow_payload;
use crate::columns::ValueType;
use crate::failure::{Code, Failure, reason_of};

/// Room for an identifier in the summary, with its zero.
const ID_SIZE: usize = 128;
const READ_BUFFER_BYTES: usize = 1 << 20;

#[repr(C)]
pub struct CCell {
    entity: *const c_char,
    component: *const c_char,
    value_type: u32,
    width: u32,
    instances: u64,
    data: *const u8,
    text_ends: *const u64,
    time_count: usize,
    time_names: *const *const c_char,
    times: *const i64,
}

pub type CCallback = extern "C" fn(user: *mut c_void, cell: *const CCell) -> c_int;

#[repr(C)]
pub struct CSummary {
    finished: c_int,
    file_bytes: u64,
    cut_bytes: u64,
    chunks: u64,
    application_id: [c_char; ID_SIZE],
    recording_id: [c_char; ID_SIZE],
}

impl Default for CSummary {
    fn default() -> Self {
        Self {
            finished: 0,
            file_bytes: 0,
            cut_bytes: 0,
            chunks: 0,
            application_id: [0; ID_SIZE],
            recording_id: [0; ID_SIZE],
        }
    }
}

/// Where the file's frames end.
struct Frames {
    file_bytes: u64,
    whole_bytes: u64,
    finished: bool,
}

fn no_recording(path: &str, reason: impl std::fmt::Display) -> Failure {
    Failure::new(
        Code::Malformed,
        format!("{path}: not a recording: {reason}"),
    )
}

fn damaged(path: &str, at: u64, reason: impl std::fmt::Display) -> Failure {
    Failure::new(
        Code::Malformed,
        format!("{path}: damaged at byte {at}: {reason}; copy it again or record it again"),
    )
}

fn walk_frames(path: &str, file: &mut File) -> Result<Frames, Failure> {
    let io = |e: std::io::Error| Failure::new(Code::Io, format!("reading {path}: {e}"));
    let file_bytes = file.seek(SeekFrom::End(0)).map_err(io)?;
    file.rewind().map_err(io)?;
    let mut reader = BufReader::new(file);

    let mut header = [0; StreamHeader::ENCODED_SIZE_BYTES];
    reader
        .read_exact(&mut header)
        .map_err(|_| no_recording(path, "it is too short"))?;
    StreamHeader::from_rrd_bytes(&header).map_err(|e| no_recording(path, e))?;

    let mut at = header.len() as u64;
    let mut finished = false;
    while !finished && at + MessageHeader::ENCODED_SIZE_BYTES as u64 <= file_bytes {
        let mut bytes = [0; MessageHeader::ENCODED_SIZE_BYTES];
        reader.read_exact(&mut bytes).map_err(io)?;
        let frame = MessageHeader::from_rrd_bytes(&bytes).map_err(|e| damaged(path, at, e))?;
        let begin = at + bytes.len() as u64;
        match begin.checked_add(frame.len) {
            Some(end) if end <= file_bytes => {
                finished = frame.kind == MessageKind::End && has_footer(&mut reader, frame.len);
                if frame.kind != MessageKind::End {
                    reader.seek_relative(frame.len as i64).map_err(io)?;
                } else if !finished {
                    break;
                }
                at = end;
            }
            _ => break,
        }
    }
    Ok(Frames {
        file_bytes,
        whole_bytes: at,
        finished,
    })
}

/// Whether the payload of the end message is followed by a footer whose checksum it has.
fn has_footer(reader: &mut impl Read, payload_bytes: u64) -> bool {
    let mut payload = vec![0; payload_bytes as usize];
    let mut footer = [0; StreamFooter::ENCODED_SIZE_BYTES];
    if reader
        .read_exact(&mut payload)
        .and_then(|()| reader.read_exact(&mut footer))
        .is_err()
    {
        return false;
    }
    StreamFooter::from_rrd_bytes(&footer).is_ok_and(|footer| {
        let checksum = StreamFooter::compute_crc(&payload);
        footer
            .entries
            .first()
            .is_some_and(|entry| entry.crc_excluding_header == checksum)
    })
}

pub fn read(
    path: &str,
    entity_prefix: &str,
    callback: CCallback,
    user: *mut c_void,
    summary: &mut CSummary,
) -> Result<(), Failure> {
    let mut file =
        File::open(path).map_err(|e| Failure::new(Code::Io, format!("cannot open {path}: {e}")))?;
    if file.metadata().is_ok_and(|about| about.is_dir()) {
        return Err(no_recording(path, "it is a folder"));
    }
    let frames = walk_frames(path, &mut file)?;
    summary.file_bytes = frames.file_bytes;
    summary.finished = c_int::from(frames.finished);
    summary.cut_bytes = if frames.finished {
        0
    } else {
        frames.file_bytes - frames.whole_bytes
    };

    file.rewind()
        .map_err(|e| Failure::new(Code::Io, format!("reading {path}: {e}")))?;
    let whole = BufReader::with_capacity(READ_BUFFER_BYTES, file.take(frames.whole_bytes));
    let mut at = 0;
    // Arrow panics over some numbers that cannot be, as of a slice longer than its buffer.
    let decoded = catch_unwind(AssertUnwindSafe(|| {
        decode(path, whole, entity_prefix, callback, user, summary, &mut at)
    }));
    decoded.unwrap_or_else(|panic| Err(damaged(path, at, reason_of(panic.as_ref()))))
}

/// Reads frame by frame; `at` is the end of the one that was taken last.
fn decode(
    path: &str,
    whole: impl BufRead,
    entity_prefix: &str,
    callback: CCallback,
    user: *mut c_void,
    summary: &mut CSummary,
    at: &mut u64,
) -> Result<(), Failure> {
    let mut decoder = DecoderTransport::decode_lazy(whole);
    let mut ids = CachingApplicationIdInjector::default();
    while let Some(message) = decoder.next() {
        *at = decoder.num_bytes_processed();
        let mut message = message.map_err(|e| damaged(path, *at, e))?;
        if let Msg::ArrowMsg(arrow) = &mut message {
            arrow_payload::unpack(arrow).map_err(|e| damaged(path, *at, e))?;
        }
        match message
            .to_application((&mut ids, None))
            .map_err(|e| damaged(path, *at, e))?
        {
            LogMsg::SetStoreInfo(info) if info.info.store_id.is_recording() => {
                let store = &info.info.store_id;
                copy_id(&mut summary.application_id, store.application_id().as_str());
                copy_id(&mut summary.recording_id, store.recording_id().as_str());
            }
            LogMsg::ArrowMsg(store, message) if store.is_recording() => {
                summary.chunks += 1;
                let chunk = Chunk::from_arrow_msg(&message).map_err(|e| damaged(path, *at, e))?;
                read_chunk(&chunk, entity_prefix, callback, user)?;
            }
            _ => {}
        }
    }
    Ok(())
}

fn copy_id(target: &mut [c_char; ID_SIZE], id: &str) {
    for (to, from) in target[..ID_SIZE - 1].iter_mut().zip(id.bytes()) {
        *to = from as c_char;
    }
}

fn c_text(text: &str) -> CString {
    CString::new(text.replace('\0', "")).unwrap_or_default()
}

fn read_chunk(
    chunk: &Chunk,
    entity_prefix: &str,
    callback: CCallback,
    user: *mut c_void,
) -> Result<(), Failure> {
    let path = chunk.entity_path();
    let is_properties = *path == EntityPath::properties();
    let path = path.to_string();
    let path = path.trim_start_matches('/');
    if is_properties || !path.starts_with(entity_prefix) {
        return Ok(());
    }
    let entity = c_text(path);

    let mut timelines: Vec<_> = chunk.timelines().values().collect();
    timelines.sort_by_key(|column| column.name().to_owned());
    let names: Vec<CString> = timelines
        .iter()
        .map(|column| c_text(column.name()))
        .collect();
    let name_pointers: Vec<*const c_char> = names.iter().map(|name| name.as_ptr()).collect();

    let mut components: Vec<_> = chunk.components().0.iter().collect();
    components.sort_by_key(|(id, _)| id.to_string());
    let components: Vec<(CString, &ListArray)> = components
        .into_iter()
        .map(|(id, column)| (c_text(id.as_str()), &column.list_array))
        .collect();

    for row in 0..chunk.num_rows() {
        let times: Vec<i64> = timelines
            .iter()
            .map(|column| column.times_raw()[row])
            .collect();
        for (component, list) in &components {
            if list.is_null(row) {
                continue;
            }
            let Some(values) = Values::from_arrow(&list.value(row)) else {
                continue;
            };
            let cell = CCell {
                entity: entity.as_ptr(),
                component: component.as_ptr(),
                value_type: values.value_type as u32,
                width: values.width,
                instances: values.instances as u64,
                data: values.data,
                text_ends: values.text_ends.as_ptr(),
                time_count: times.len(),
                time_names: name_pointers.as_ptr(),
                times: times.as_ptr(),
            };
            if callback(user, &raw const cell) != 0 {
                return Err(Failure::new(Code::Stopped, "the reader was asked to stop"));
            }
        }
    }
    Ok(())
}

/// The numbers or texts of one cell, in Arrow's memory.
struct Values {
    value_type: ValueType,
    width: u32,
    instances: usize,
    data: *const u8,
    text_ends: Vec<u64>,
    _owner: ArrayRef,
}

impl Values {
    fn from_arrow(instances: &ArrayRef) -> Option<Self> {
        let (width, values) = match instances.as_any().downcast_ref::<FixedSizeListArray>() {
            Some(list) => {
                let width = list.value_length() as usize;
                let begin = list.value_offset(0) as usize;
                (width, list.values().slice(begin, list.len() * width))
            }
            None => (1, instances.clone()),
        };
        if values.null_count() != 0 {
            return None;
        }
        let mut text_ends = Vec::new();
        let (value_type, data) = match values.data_type() {
            DataType::Float32 => (ValueType::F32, pointer::<Float32Type>(&values)?),
            DataType::Float64 => (ValueType::F64, pointer::<Float64Type>(&values)?),
            DataType::UInt8 => (ValueType::U8, pointer::<UInt8Type>(&values)?),
            DataType::UInt32 => (ValueType::U32, pointer::<UInt32Type>(&values)?),
            DataType::UInt64 => (ValueType::U64, pointer::<UInt64Type>(&values)?),
            DataType::Utf8 => {
                let texts = values.as_any().downcast_ref::<StringArray>()?;
                let begin = texts.value_offsets()[0];
                text_ends = texts.value_offsets()[1..]
                    .iter()
                    .map(|e| (e - begin) as u64)
                    .collect();
                (
                    ValueType::Text,
                    texts.value_data()[begin as usize..].as_ptr(),
                )
            }
            _ => return None,
        };
        let count = instances.len();
        Some(Self {
            value_type,
            width: width as u32,
            instances: count,
            data,
            text_ends,
            _owner: values,
        })
    }
}

fn pointer<T: ArrowPrimitiveType>(values: &ArrayRef) -> Option<*const u8> {
    let array = values.as_any().downcast_ref::<PrimitiveArray<T>>()?;
    Some(array.values().as_ptr().cast())
}
