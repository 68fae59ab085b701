/* C interface of the crate plumb_rerun: write and read Rerun recordings (.rrd).
 *
 * Every function that can fail returns 0 for success, else a positive code, and writes a text into
 * `error` (cut to `error_size` bytes, always zero-terminated; may be null). Nothing throws, nothing
 * panics through this border. One writer may be used from one thread at a time.
 */
#ifndef PLUMB_RERUN_H
#define PLUMB_RERUN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum plumb_rr_code {
  PLUMB_RR_OK = 0,
  PLUMB_RR_BAD_ARGUMENT = 1, /* the caller's mistake: null pointer, unknown component, bad shape */
  PLUMB_RR_IO = 2,           /* the operating system said no; the text names the file */
  PLUMB_RR_TIMEOUT = 3,      /* the writer thread did not get there in time; it goes on trying */
  PLUMB_RR_MALFORMED = 4,    /* the file is not, or not wholly, a recording */
  PLUMB_RR_STOPPED = 5,      /* the callback asked to stop */
  PLUMB_RR_PANIC = 6         /* a defect inside the bridge, caught */
} plumb_rr_code;

typedef enum plumb_rr_type {
  PLUMB_RR_F32 = 0,
  PLUMB_RR_F64 = 1,
  PLUMB_RR_U8 = 2,
  PLUMB_RR_U32 = 3,
  PLUMB_RR_U64 = 4,
  PLUMB_RR_TEXT = 5 /* UTF-8 */
} plumb_rr_type;

/* One column of a chunk. A component is a component of a Rerun archetype ("Boxes3D:centers"; type
 * and width are checked) or one of the user's own ("plumb.<Archetype>:<field>"; any type). */
typedef struct plumb_rr_column {
  const char* component;
  uint32_t type;             /* plumb_rr_type */
  uint32_t width;            /* numbers per instance, >= 1; 1 for text */
  const void* data;          /* instances one after the other; text: the bytes of all strings */
  uint64_t instances;        /* in all rows together */
  const uint32_t* counts;    /* instances of each row; null: the same in every row */
  const uint64_t* text_ends; /* text only: end of each string in data */
} plumb_rr_column;

typedef enum plumb_rr_time_kind {
  PLUMB_RR_SEQUENCE = 0,
  PLUMB_RR_DURATION = 1 /* nanoseconds */
} plumb_rr_time_kind;

typedef struct plumb_rr_timeline {
  const char* name;
  uint32_t kind;         /* plumb_rr_time_kind */
  const int64_t* values; /* one per row */
} plumb_rr_timeline;

/* Rows of one entity. Without timelines: static, valid at all times, one row. */
typedef struct plumb_rr_chunk {
  const char* entity;
  uint64_t rows;
  const plumb_rr_timeline* timelines;
  size_t timeline_count;
  const plumb_rr_column* columns;
  size_t column_count;
} plumb_rr_chunk;

typedef enum plumb_rr_view_kind {
  PLUMB_RR_VIEW_3D = 0,
  PLUMB_RR_VIEW_PLOT = 1,
  PLUMB_RR_VIEW_TEXT_LOG = 2,
  PLUMB_RR_VIEW_DOCUMENT = 3
} plumb_rr_view_kind;

typedef struct plumb_rr_view {
  uint32_t kind; /* plumb_rr_view_kind */
  const char* name;
  const char* contents; /* entity expressions, one a line: "+ /world/.." and so on */
  uint32_t tab;         /* views with the same number share a place in the column, as tabs */
} plumb_rr_view;

/* Layout shown when the file is opened: 3D views left, the others in a column right. Of several
 * the last one is shown. */
typedef struct plumb_rr_layout {
  const plumb_rr_view* views;
  size_t view_count;
  const char* timeline;           /* that the time panel stands on */
  float frames_per_second;        /* > 0, playback of a sequence timeline */
  float eye[3], target[3], up[3]; /* first 3D view; eye equal to target: left to the viewer */
  const char* followed;           /* entity that the eye goes with; null: none */
  float grid_height;              /* along `up` [m], of a grid of lines */
  float grid_spacing;             /* [m]; 0: no grid */
} plumb_rr_layout;

typedef struct plumb_rr_writer plumb_rr_writer;

/* Creates (or overwrites) a recording. Null on failure. */
plumb_rr_writer* plumb_rr_open(const char* path, const char* application_id,
                               const char* recording_name, char* error, size_t error_size);
int plumb_rr_send_layout(plumb_rr_writer* writer, const plumb_rr_layout* layout, char* error,
                         size_t error_size);
/* Copies the columns and returns; a thread of the writer encodes, compresses and writes them.
 * Blocks only while more than a fixed number of bytes waits to be written. After a failed write
 * every call returns that failure at once. */
int plumb_rr_send(plumb_rr_writer* writer, const plumb_rr_chunk* chunk, char* error,
                  size_t error_size);
/* Returns when all that was sent is with the operating system; durable: on the disk. */
int plumb_rr_flush(plumb_rr_writer* writer, double timeout_seconds, int durable, char* error,
                   size_t error_size);
uint64_t plumb_rr_bytes_written(const plumb_rr_writer* writer);
/* Writes the footer and frees the writer, in any case. */
int plumb_rr_close(plumb_rr_writer* writer, double timeout_seconds, char* error, size_t error_size);

/* One component of one row. All pointers are valid during the callback only. */
typedef struct plumb_rr_cell {
  const char* entity; /* without leading slash */
  const char* component;
  uint32_t type;
  uint32_t width;
  uint64_t instances;
  const void* data; /* aligned for its type */
  const uint64_t* text_ends;
  size_t time_count; /* 0: static */
  const char* const* time_names;
  const int64_t* times;
} plumb_rr_cell;

typedef int (*plumb_rr_cell_callback)(void* user, const plumb_rr_cell* cell); /* nonzero: stop */

typedef struct plumb_rr_summary {
  int finished; /* the footer is there and whole: the writer was closed */
  uint64_t file_bytes;
  uint64_t cut_bytes; /* at the end of the file, of a message that is not whole */
  uint64_t chunks;
  char application_id[128];
  char recording_id[128];
} plumb_rr_summary;

/* Reads a recording from begin to end, in the order it was written. Entities that do not begin with
 * `entity_prefix` and components of other types than those above are passed by. The summary is
 * filled as far as the file could be read, also on failure. */
int plumb_rr_read(const char* path, const char* entity_prefix, plumb_rr_cell_callback callback,
                  void* user, plumb_rr_summary* summary, char* error, size_t error_size);

/* "0.36.3": the Rerun release inside. */
const char* plumb_rr_sdk_version(void);

#ifdef __cplusplus
}
#endif
#endif
