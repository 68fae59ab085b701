//! Columns as C gives them, copied, and turned into a Rerun chunk (one Arrow list array a column).

use std::ffi::c_char;
use std::sync::Arc;

use arrow::array::{
    ArrayRef, FixedSizeListArray, Float32Array, Float64Array, ListArray, StringArray, UInt8Array,
    UInt32Array, UInt64Array,
};
use arrow::buffer::{Buffer, OffsetBuffer, ScalarBuffer};
use arrow::datatypes::Field;
use re_chunk::{Chunk, TimeColumn};
use re_log_types::{TimeType, Timeline, TimelineName};
use re_sdk_types::ComponentDescriptor;

use crate::components;
use crate::failure::{Code, Failure, text_from};

#[repr(C)]
pub struct CColumn {
    component: *const c_char,
    value_type: u32,
    width: u32,
    data: *const u8,
    instances: u64,
    counts: *const u32,
    text_ends: *const u64,
}

#[repr(C)]
pub struct CTimeline {
    name: *const c_char,
    kind: u32,
    values: *const i64,
}

#[repr(C)]
pub struct CChunk {
    entity: *const c_char,
    rows: u64,
    timelines: *const CTimeline,
    timeline_count: usize,
    columns: *const CColumn,
    column_count: usize,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u32)]
pub enum ValueType {
    F32 = 0,
    F64 = 1,
    U8 = 2,
    U32 = 3,
    U64 = 4,
    Text = 5,
}

impl ValueType {
    fn from_c(value: u32) -> Result<Self, Failure> {
        [
            Self::F32,
            Self::F64,
            Self::U8,
            Self::U32,
            Self::U64,
            Self::Text,
        ]
        .into_iter()
        .find(|candidate| *candidate as u32 == value)
        .ok_or_else(|| Failure::argument(format!("{value} is no column type")))
    }

    fn size(self) -> usize {
        match self {
            Self::F32 | Self::U32 => 4,
            Self::F64 | Self::U64 => 8,
            Self::U8 | Self::Text => 1,
        }
    }
}

struct OwnedColumn {
    descriptor: ComponentDescriptor,
    value_type: ValueType,
    width: u32,
    instances: usize,
    /// Arrow buffers are aligned for every type.
    data: Buffer,
    counts: Vec<usize>,
    text_ends: Vec<usize>,
}

struct OwnedTimeline {
    name: String,
    kind: TimeType,
    values: Vec<i64>,
}

/// A chunk that no longer needs the caller's memory.
pub struct OwnedChunk {
    entity: String,
    timelines: Vec<OwnedTimeline>,
    columns: Vec<OwnedColumn>,
    pub bytes: usize,
}

/// # Safety
/// `count` values of T behind the pointer, unless count is 0.
unsafe fn slice<'a, T>(pointer: *const T, count: usize, name: &str) -> Result<&'a [T], Failure> {
    if count == 0 {
        return Ok(&[]);
    }
    if pointer.is_null() {
        return Err(Failure::argument(format!("{name} is null")));
    }
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

impl OwnedChunk {
    /// # Safety
    /// All pointers as `plumb_rerun.h` says.
    pub unsafe fn copy_from(chunk: &CChunk) -> Result<Self, Failure> {
        let entity = unsafe { text_from(chunk.entity, "entity")? }.to_owned();
        let rows = chunk.rows as usize;
        if rows == 0 || chunk.column_count == 0 {
            return Err(Failure::argument(format!(
                "{entity}: a chunk needs rows and columns"
            )));
        }
        let mut timelines = Vec::with_capacity(chunk.timeline_count);
        for line in unsafe { slice(chunk.timelines, chunk.timeline_count, "timelines")? } {
            timelines.push(OwnedTimeline {
                name: unsafe { text_from(line.name, "timeline name")? }.to_owned(),
                kind: match line.kind {
                    0 => TimeType::Sequence,
                    1 => TimeType::DurationNs,
                    other => {
                        return Err(Failure::argument(format!("{other} is no kind of timeline")));
                    }
                },
                values: unsafe { slice(line.values, rows, "timeline values")? }.to_vec(),
            });
        }
        let mut columns = Vec::with_capacity(chunk.column_count);
        let mut bytes = 0;
        for column in unsafe { slice(chunk.columns, chunk.column_count, "columns")? } {
            let column = unsafe { OwnedColumn::copy_from(column, rows)? };
            bytes += column.data.len();
            columns.push(column);
        }
        Ok(Self {
            entity,
            timelines,
            columns,
            bytes,
        })
    }

    pub fn into_chunk(self) -> Result<Chunk, Failure> {
        let entity = self.entity;
        let failed = |error: String| Failure::new(Code::BadArgument, format!("{entity}: {error}"));
        let mut timelines = Vec::with_capacity(self.timelines.len());
        for line in self.timelines {
            let name = TimelineName::try_new(line.name).map_err(|e| failed(e.to_string()))?;
            let timeline = Timeline::new(name, line.kind);
            timelines.push(TimeColumn::new(
                None,
                timeline,
                ScalarBuffer::from(line.values),
            ));
        }
        let mut columns = Vec::with_capacity(self.columns.len());
        for column in self.columns {
            let descriptor = column.descriptor.clone();
            columns.push((
                descriptor,
                column.into_list().map_err(|e| failed(e.to_string()))?,
            ));
        }
        Chunk::from_columns(entity.as_str(), timelines, columns).map_err(|e| failed(e.to_string()))
    }
}

impl OwnedColumn {
    unsafe fn copy_from(column: &CColumn, rows: usize) -> Result<Self, Failure> {
        let name = unsafe { text_from(column.component, "component")? };
        let value_type = ValueType::from_c(column.value_type)?;
        let (width, instances) = (column.width, column.instances as usize);
        if width == 0 || i32::try_from(width).is_err() {
            return Err(Failure::argument(format!(
                "{name}: a width of {width} is not possible"
            )));
        }
        let counts = if column.counts.is_null() {
            if instances % rows != 0 {
                return Err(Failure::argument(format!(
                    "{name}: {instances} instances are not the same number in {rows} rows"
                )));
            }
            vec![instances / rows; rows]
        } else {
            let counts = unsafe { slice(column.counts, rows, "counts")? };
            counts.iter().map(|count| *count as usize).collect()
        };
        if counts.iter().sum::<usize>() != instances || i32::try_from(instances).is_err() {
            return Err(Failure::argument(format!(
                "{name}: counts and instances disagree"
            )));
        }
        let mut text_ends = Vec::new();
        let bytes = if value_type == ValueType::Text {
            let ends = unsafe { slice(column.text_ends, instances, "text_ends")? };
            if !ends.is_sorted() || ends.last().is_some_and(|end| i32::try_from(*end).is_err()) {
                return Err(Failure::argument(format!(
                    "{name}: ends of text must ascend"
                )));
            }
            text_ends = ends.iter().map(|end| *end as usize).collect();
            text_ends.last().copied().unwrap_or(0)
        } else {
            instances * width as usize * value_type.size()
        };
        Ok(Self {
            descriptor: components::descriptor(name, value_type, width)?,
            value_type,
            width,
            instances,
            data: Buffer::from(unsafe { slice(column.data, bytes, "data")? }),
            counts,
            text_ends,
        })
    }

    fn into_list(self) -> Result<ListArray, arrow::error::ArrowError> {
        let count = self.instances * self.width as usize;
        let values: ArrayRef = match self.value_type {
            ValueType::F32 => Arc::new(Float32Array::new(
                ScalarBuffer::new(self.data, 0, count),
                None,
            )),
            ValueType::F64 => Arc::new(Float64Array::new(
                ScalarBuffer::new(self.data, 0, count),
                None,
            )),
            ValueType::U8 => Arc::new(UInt8Array::new(
                ScalarBuffer::new(self.data, 0, count),
                None,
            )),
            ValueType::U32 => Arc::new(UInt32Array::new(
                ScalarBuffer::new(self.data, 0, count),
                None,
            )),
            ValueType::U64 => Arc::new(UInt64Array::new(
                ScalarBuffer::new(self.data, 0, count),
                None,
            )),
            ValueType::Text => {
                let begins = std::iter::once(&0).chain(&self.text_ends);
                let lengths = self
                    .text_ends
                    .iter()
                    .zip(begins)
                    .map(|(end, begin)| end - begin);
                let offsets = OffsetBuffer::from_lengths(lengths);
                Arc::new(StringArray::try_new(offsets, self.data, None)?)
            }
        };
        let instances: ArrayRef = if self.width == 1 {
            values
        } else {
            let item = Arc::new(Field::new("item", values.data_type().clone(), false));
            Arc::new(FixedSizeListArray::try_new(
                item,
                self.width as i32,
                values,
                None,
            )?)
        };
        let item = Arc::new(Field::new("item", instances.data_type().clone(), true));
        ListArray::try_new(
            item,
            OffsetBuffer::from_lengths(self.counts),
            instances,
            None,
        )
    }
}
