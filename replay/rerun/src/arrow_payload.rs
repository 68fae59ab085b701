//! Unpacking the Arrow data of a message once every length in it is known to fit.
//!
//! Behind the SDK's decoder and Arrow's reader, memory is set aside for the lengths that a message
//! names before anyone looks whether so much follows. A length that one tipped bit made huge would
//! end the program there, and no panic could be caught. So the lengths are looked at here first.

use arrow::ipc::{MessageHeader, root_as_message};
use re_log_encoding::external::lz4_flex;
use re_protos::common::v1alpha1::Compression;
use re_protos::log_msg::v1alpha1::ArrowMsg;

/// A byte of an LZ4 block stands for at most so many of its text.
const LZ4_LARGEST_RATIO: u64 = 255;
/// What a message of Arrow's stream begins with, before the length of its description.
const CONTINUATION: u32 = u32::MAX;

/// Leaves the payload uncompressed, or says what in it cannot be.
pub fn unpack(message: &mut ArrowMsg) -> Result<(), String> {
    if message.compression() == Compression::Lz4 {
        let packed = message.payload.len() as u64;
        let unpacked = message.uncompressed_size;
        if unpacked / LZ4_LARGEST_RATIO > packed {
            return Err(format!("{packed} bytes cannot hold {unpacked} compressed"));
        }
        let mut bytes = vec![0; unpacked as usize];
        lz4_flex::block::decompress_into(&message.payload, &mut bytes)
            .map_err(|e| e.to_string())?;
        message.payload = bytes.into();
        message.set_compression(Compression::None);
    }
    check_stream(&message.payload)
}

/// The messages of an Arrow stream: their lengths stay within it.
fn check_stream(stream: &[u8]) -> Result<(), String> {
    let mut rest = stream;
    while let Some(mut length) = take_u32(&mut rest) {
        if length == CONTINUATION {
            length = take_u32(&mut rest).unwrap_or(0);
        }
        if length == 0 {
            break; // the end of the stream
        }
        // A copy: what reads it asks for memory aligned as an allocation is.
        let description = take(&mut rest, u64::from(length), "a description")?.to_vec();
        let message = root_as_message(&description).map_err(|e| e.to_string())?;
        let body = u64::try_from(message.bodyLength()).map_err(|_| "a negative length")?;
        take(&mut rest, body, "a body")?;
        check_batch(&message, body)?;
    }
    Ok(())
}

/// The parts of a batch of rows lie within its body, and none is compressed once more.
fn check_batch(message: &arrow::ipc::Message<'_>, body: u64) -> Result<(), String> {
    let batch = match message.header_type() {
        MessageHeader::RecordBatch => message.header_as_record_batch(),
        MessageHeader::DictionaryBatch => message
            .header_as_dictionary_batch()
            .and_then(|dictionary| dictionary.data()),
        _ => None,
    };
    let Some(batch) = batch else { return Ok(()) };
    if batch.compression().is_some() {
        return Err("its columns are compressed, which no recorder does".to_owned());
    }
    for part in batch.buffers().iter().flatten() {
        let end = part.offset().checked_add(part.length());
        if part.offset() < 0 || part.length() < 0 || end.is_none_or(|end| end as u64 > body) {
            return Err("a column reaches beyond its body".to_owned());
        }
    }
    Ok(())
}

fn take<'a>(rest: &mut &'a [u8], length: u64, what: &str) -> Result<&'a [u8], String> {
    if length > rest.len() as u64 {
        return Err(format!(
            "{what} of {length} bytes where {} follow",
            rest.len()
        ));
    }
    let (taken, left) = rest.split_at(length as usize);
    *rest = left;
    Ok(taken)
}

fn take_u32(rest: &mut &[u8]) -> Option<u32> {
    let (bytes, left) = rest.split_first_chunk()?;
    *rest = left;
    Some(u32::from_le_bytes(*bytes))
}
