/* SPDX-License-Identifier: Apache-2.0
 *
 * msq: multiscale set queries. A coarse shape and fine-scale structures (strut
 * lattices, Voronoi foams) answered point by point, set by set and layer by
 * layer, without ever meshing the fine geometry.
 *
 * Source of the method: Igouchkine and Liu, "Set-based queries for multiscale
 * shape-material modeling". What the words mean exactly: docs/concepts.md.
 *
 * Rules that hold for every declaration below:
 *
 *  Units     Lengths are in the model's unit. Files are read as millimetres, so
 *            with files the model's unit is the millimetre. Coordinates are
 *            right-handed, x, y, z.
 *  Status    Every function that can fail returns msq_status: MSQ_OK (0) or a
 *            negative MSQ_E_*. msq_error_message() then says what was wrong, with
 *            the value and the limit. On failure no output argument is written,
 *            save where a function says so.
 *  Handles   Opaque, reference-counted and immutable once built: any number of
 *            threads may use one handle at once. X_create and its kin return a
 *            handle with one reference; X_retain adds one, X_release drops one and
 *            frees the object with the last. Retaining and releasing NULL do nothing.
 *            A handle keeps alive whatever it was built from, so release order is
 *            free, also from within a callback. What one model is built from should
 *            come from one context: memory and cached cells count where they were made.
 *  Structs   A definition begins with struct_size. X_def_init(&def, sizeof def)
 *            sets it and the defaults, and writes no byte past that size. A struct
 *            that is longer than the library knows must be zero in the rest. In a
 *            report, which msq fills in, the caller sets struct_size and msq writes
 *            no byte past it, and 0 into what it does not know. Sizes below that of
 *            version 0.1 and above 4096 are refused.
 *  Inputs    Arrays and strings given to a constructor are copied; the caller keeps
 *            its own. NULL is refused save where a function gives it a meaning.
 *            Non-finite numbers are refused.
 *  Threads   Callbacks of a call run on the thread that made the call, and may call msq. Only those of
 *            objects that the host defined with concurrent = 1 may run on any thread of msq.
 *  Process   msq never prints, exits, aborts, installs a signal handler, reads the
 *            environment or changes locale or floating-point state, and lets no
 *            C++ exception out. (oneTBB, which runs the threads, prints its version
 *            where the environment has TBB_VERSION set.)
 *  Cost      Where a comment says none, a call costs next to nothing.
 *
 * Every declaration is here since 0.1 unless it says otherwise.
 */
#ifndef MSQ_H
#define MSQ_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(MSQ_SHARED)
#ifdef MSQ_BUILDING
#define MSQ_API __declspec(dllexport)
#else
#define MSQ_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define MSQ_API __attribute__((visibility("default")))
#else
#define MSQ_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- version, status, errors ------------------------------------------- */

#define MSQ_VERSION_MAJOR 0
#define MSQ_VERSION_MINOR 1
#define MSQ_VERSION_PATCH 0
/* major * 10000 + minor * 100 + patch, of this header. */
#define MSQ_VERSION 100

typedef int32_t msq_status; /* MSQ_OK or one of MSQ_E_* */

enum {
  MSQ_OK = 0,
  MSQ_E_ARGUMENT = -1,    /* an argument is NULL, non-finite, out of range or inconsistent */
  MSQ_E_MEMORY = -2,      /* an allocation failed */
  MSQ_E_CANCELLED = -3,   /* the job was cancelled */
  MSQ_E_HOST = -4,        /* a host callback asked to stop: msq_error_host_code(); or its answer
                             cannot be: code 0 */
  MSQ_E_IO = -5,          /* a file cannot be opened or read */
  MSQ_E_UNSUPPORTED = -6, /* not in this build, or a file format that msq does not read */
  MSQ_E_MESH = -7,        /* mesh data that cannot be made sense of (not: a dirty mesh) */
  MSQ_E_LIMIT = -8,       /* a stated limit, such as the context's memory limit, would be passed */
  MSQ_E_INTERNAL = -9     /* a defect in msq: please report it */
};

/* Version of the loaded library, to compare with MSQ_VERSION. Never fails. */
MSQ_API uint32_t msq_version(void);

/* Name of a status, such as "MSQ_E_LIMIT"; "MSQ_E_UNKNOWN" for other numbers.
 * Static storage. */
MSQ_API const char *msq_status_name(msq_status status);

/* Message of the last failure on the calling thread, UTF-8; "" before the first. Valid until the
 * next call on this thread that fails: calls that succeed leave it. */
MSQ_API const char *msq_error_message(void);

/* Code that the host's callback returned at the last MSQ_E_HOST on the calling thread; 0 before. */
MSQ_API int32_t msq_error_host_code(void);

typedef struct msq_build_report {
  uint32_t struct_size; /* in: sizeof of the caller's struct */
  uint32_t version;     /* as msq_version() */
  int32_t with_assimp;  /* 1 if mesh files can be read */
  int32_t with_cgal;    /* 1 if MSQ_FOAM_METHOD_2 and msq_shape_self_intersections are available */
  const char *licence;  /* effective SPDX licence of this binary with what it is built upon; static */
  const char *simd;     /* instruction set that the kernels use on this machine, e.g. "AVX3"; static */
} msq_build_report;

/* Says how the loaded library was built. Errors: ARGUMENT. */
MSQ_API msq_status msq_build_info(msq_build_report *report);

/* ---- context and job ----------------------------------------------------- */

typedef struct msq_context msq_context; /* threads, cell cache and memory limit that objects share */
typedef struct msq_job msq_job;         /* one long call: its progress, and the means to cancel it */

/* Which cached cells make room for others; those that a call is using are passed over. */
enum {
  MSQ_CACHE_FIFO = 0,     /* the oldest: best for slices from one end to the other */
  MSQ_CACHE_SEGMENTED = 1 /* rather those that were asked for once: for frames and sets that come back to
                             more cells than fit (S3-FIFO) */
};

typedef struct msq_context_def {
  uint32_t struct_size;
  uint32_t threads;      /* threads of a call, the caller's included; 0 (default) and more than the
                            machine has: one a core; 1: the calling thread alone */
  uint64_t cache_bytes;  /* limit of the cache of cell data (default 1 GiB); 0: no cache. Same
                            results at any size. */
  uint64_t memory_limit; /* bytes that meshes, images, slabs, cached cells and the reading of files (8 times
                            the file's size) may hold at once; cached cells give way to the rest.
                            0 (default): no limit */
  int32_t cache_policy;  /* MSQ_CACHE_*; default FIFO. Same results by either; they differ where the
                            cache is smaller than what a call comes back to (docs/benchmarks.md). */
  uint32_t reserved;     /* 0 */
} msq_context_def;

/* Sets defaults. size: sizeof of the caller's struct. Errors: ARGUMENT. */
MSQ_API msq_status msq_context_def_init(msq_context_def *def, size_t size);

/* Creates a context; def NULL: defaults. Results never depend on it. Cost: starts no threads yet. Errors: ARGUMENT, MEMORY. */
MSQ_API msq_status msq_context_create(const msq_context_def *def, msq_context **context);
MSQ_API void msq_context_retain(msq_context *context);
MSQ_API void msq_context_release(msq_context *context);

typedef struct msq_memory_report {
  uint32_t struct_size;
  uint32_t reserved;    /* 0 */
  uint64_t bytes;       /* held now by meshes, images, slabs and cached cells */
  uint64_t peak_bytes;  /* most ever held at once */
  uint64_t limit_bytes; /* as in the definition; 0: no limit */
} msq_memory_report;

/* Memory accounted to the context. Any thread, at any time. Errors: ARGUMENT. */
MSQ_API msq_status msq_context_memory(const msq_context *context, msq_memory_report *report);

typedef struct msq_cache_report {
  uint32_t struct_size;
  uint32_t reserved; /* 0 */
  uint64_t hits, misses, evictions; /* of cells */
  uint64_t bytes;                   /* held now, by cells and for cells that are being built; never
                                       above limit_bytes */
  uint64_t peak_bytes, limit_bytes;
  uint64_t building_bytes;          /* of bytes: set aside for cells that are being built */
  uint64_t cells;                   /* held now */
  uint64_t duplicates;              /* of misses: two threads built the cell at once */
  uint64_t unkept;                  /* of misses: no room was found, and the cell served one caller */
} msq_cache_report;

/* Counters of the cell cache since the context was made. Any thread, at any time. Room for a cell is
 * set aside before it is built, as much as cells of its structure lately took; one that turns out
 * larger is counted in full from then on. Not counted: what builders work with, unkept cells, and
 * cells that a call uses while msq_cache_clear or a memory_limit drops them.
 * Errors: ARGUMENT. Source: paper, section "Set Queries for Ray-Casting" (FIFO cache). */
MSQ_API msq_status msq_cache_stats(const msq_context *context, msq_cache_report *report);

/* Drops all cached cells (calls in flight keep theirs). Counters stay. A structure's cells go with the last
 * reference to it, that of a model included. Errors: ARGUMENT. */
MSQ_API msq_status msq_cache_clear(msq_context *context);

/* Creates a job to pass to one long call at a time (in two at once, their progress is mixed). Errors: ARGUMENT, MEMORY. */
MSQ_API msq_status msq_job_create(msq_job **job);
MSQ_API void msq_job_retain(msq_job *job);
MSQ_API void msq_job_release(msq_job *job);

/* Asks the call that works under the job to stop; it returns MSQ_E_CANCELLED when the tiles or layers
 * in work are done, mostly within tens of milliseconds (arrays asked of foams by MSQ_FOAM_POINT,
 * seconds, at a large radius minutes). Stays set: calls made later under this job stop at once. Any thread. Errors: ARGUMENT. */
MSQ_API msq_status msq_job_cancel(msq_job *job);

/* Fraction done, 0 to 1, of the last call under the job; 1 only after success. Any thread.
 * Errors: ARGUMENT. */
MSQ_API msq_status msq_job_progress(const msq_job *job, double *fraction);

typedef struct msq_job_report {
  uint32_t struct_size;
  uint32_t reserved;  /* 0 */
  uint64_t points;    /* of a set query, answered */
  uint64_t by_shape;  /* of these, answered by the coarse shape alone: outside it, or no finer scale resolved */
  uint64_t by_point;  /* asked of structures one by one: counted once for each structure that is asked */
  uint64_t by_set;    /* asked of structures in groups, likewise */
  uint64_t groups;    /* into which by_set fell; of grids, tiles of rows */
} msq_job_report;

/* What answered the points of the last call under the job, a set query or statistic (0 for others),
 * as far as it has come. Any thread. Errors: ARGUMENT.
 * Source: paper, section "Structured and Unstructured Set Queries" (critical number of points). */
MSQ_API msq_status msq_job_info(const msq_job *job, msq_job_report *report);

/* ---- objects that the host defines ----------------------------------------- */

/* Fields, shapes and structures may be functions of the host's own, which msq calls with batches of
 * points: msq_field_host, msq_shape_from_host, msq_structure_host, msq_structure_host_function. Of all of
 * their callbacks it holds:
 *
 *  Answers   depend on the arguments alone: a point has the same answer, to the last bit, whenever it
 *            is asked and whatever else is in its batch.
 *  Threads   concurrent = 0 (default): they run on the thread that made the call to msq, one at a time,
 *            and models with such an object are computed by that thread alone. (Calls that the host
 *            makes at once call back at once, each on its own thread.) concurrent = 1: they may run on
 *            any thread of msq, several at once.
 *  Failure   They return 0 to go on; any other code, best negative, stops the call with MSQ_E_HOST.
 *            So do answers that are no number or beyond what the definition states, with code 0. What
 *            a failed set query was to write may then be partly written. Exceptions of the host's
 *            language must not leave them.
 *  Lifetime  Each gets the definition's user. release, if not NULL, gets it once, when the object is
 *            freed and no callback will come any more, on the thread that let go of it last; not where
 *            the constructor fails. They may call msq, not on what they are part of.
 *
 * Points and boxes belong to msq and are valid until the callback returns. Coordinates are triples
 * x, y, z, and a batch has at most 4096 points. docs/hosts.md shows the smallest example. */

typedef void (*msq_release_fn)(void *user);

/* values[i] = the value at point i, for i < count. */
typedef int32_t (*msq_values_fn)(void *user, const double *points, uint64_t count,
                                 double *values);

/* *low and *high: bounds, rounding included, of all values in the box from min to max. */
typedef int32_t (*msq_range_fn)(void *user, const double min[3], const double max[3],
                                double *low, double *high);

/* ---- shapes: scale 0 ------------------------------------------------------ */

typedef struct msq_shape msq_shape; /* a coarse solid */

/* Which winding numbers are inside a mesh. */
enum {
  MSQ_WINDING_NONZERO = 0, /* any but 0 (default): overlapping and inside-out parts are solid */
  MSQ_WINDING_EVEN_ODD = 1,
  MSQ_WINDING_POSITIVE = 2 /* only parts with outward normals are solid */
};

enum { /* type of a host's numbers; coordinates are of the first two */
  MSQ_FLOAT32 = 1,
  MSQ_FLOAT64 = 2,
  MSQ_UINT8 = 3,
  MSQ_INT16 = 4,
  MSQ_UINT16 = 5
};

enum { /* mesh file formats; the only ones read */
  MSQ_FORMAT_AUTO = 0, /* by the file's extension */
  MSQ_FORMAT_STL = 1,  /* binary or ASCII */
  MSQ_FORMAT_OBJ = 2,
  MSQ_FORMAT_PLY = 3,
  MSQ_FORMAT_OFF = 4,
  MSQ_FORMAT_3MF = 5,
  MSQ_FORMAT_AMF = 6
};

/* The grid of neighbourhood cells that a structure stands on, or an image. Cell (i, j, k) holds the points
 * origin + rotation * ((i, j, k) + u) * cell_size, 0 <= u < 1 in each component.
 * Source: paper, section "Multiscale Shape-Material Modeling API". */
typedef struct msq_neighbourhood {
  double origin[3];    /* default 0 */
  double cell_size[3]; /* > 0, along the grid's own axes (default 1) */
  double rotation[9];  /* row-major, orthonormal within 1e-9 (the nearest rotation is taken),
                          determinant +1 (default identity) */
} msq_neighbourhood;

/* An image: numbers on a regular grid, linear between them along x, y and z. Where one is given, its
 * values are copied, and about 1/8 byte a value kept besides. */
typedef struct msq_image {
  const void *values;    /* value (i, j, k) after i of its row, j rows of its layer, k layers */
  int32_t value_type;    /* MSQ_UINT8, INT16, UINT16, FLOAT32 or FLOAT64; no default: it must be set.
                            Floating-point values: at most 1e100 in magnitude */
  uint32_t reserved;     /* 0 */
  uint64_t size[3];      /* values along x, y and z, 1 to 2^20 */
  uint64_t row_stride;   /* bytes from one row to the next; 0 (default): tightly packed */
  uint64_t layer_stride; /* bytes from one layer to the next; 0 (default): size[1] rows */
  msq_neighbourhood grid; /* value (i, j, k) stands at the corner of the grid's cell (i, j, k) that is
                             nearest to its origin: origin + rotation * ((i, j, k) * cell_size), so
                             cell_size is the spacing of the values */
} msq_image;

typedef struct msq_file_def {
  uint32_t struct_size;
  int32_t format;         /* MSQ_FORMAT_*; AUTO (default) needs a path */
  int32_t winding_rule;   /* MSQ_WINDING_* */
  uint32_t reserved;      /* 0 */
  double unit_mm;         /* length of the file's unit in mm for STL, OBJ, PLY and OFF, which name
                             none (default 1); 3MF and AMF name theirs, and it is applied */
  uint64_t max_bytes;     /* refuse larger files, and archives that unpack to more; 0 and default:
                             4 GiB */
  uint64_t max_triangles; /* refuse more; 0 and default: 200 million */
} msq_file_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_file_def_init(msq_file_def *def, size_t size);

/* Reads a triangle mesh from a file; def NULL: defaults. All instances in the file become one shape
 * in millimetres: transforms applied, polygons triangulated, equal vertices welded, triangles
 * with fewer than three distinct vertices dropped. No other file is ever opened. Cost: linear in the file.
 * Errors: ARGUMENT, IO (no such file, truncated, malformed), UNSUPPORTED (format, or a build without
 * Assimp), MESH (no triangles, index out of range, triangle with a non-finite vertex), LIMIT, MEMORY. */
MSQ_API msq_status msq_shape_from_file(msq_context *context, const char *path,
                                       const msq_file_def *def, msq_shape **shape);

/* The same from bytes in memory; def must name the format and may not be NULL. Errors: as
 * msq_shape_from_file, IO for bytes that are truncated or malformed. */
MSQ_API msq_status msq_shape_from_memory(msq_context *context, const void *data, uint64_t bytes,
                                         const msq_file_def *def, msq_shape **shape);

typedef struct msq_mesh_def {
  uint32_t struct_size;
  int32_t coordinate_type; /* MSQ_FLOAT32 or MSQ_FLOAT64 (default) */
  int32_t winding_rule;    /* MSQ_WINDING_* */
  uint32_t reserved;       /* 0 */
  const void *vertices;    /* vertex_count triples x, y, z, at any address */
  uint64_t vertex_count;
  uint64_t vertex_stride;  /* bytes from one vertex to the next; 0 (default): tightly packed */
  const uint32_t *triangles; /* triangle_count triples of vertex indices, counter-clockwise from
                                outside */
  uint64_t triangle_count;
} msq_mesh_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_mesh_def_init(msq_mesh_def *def, size_t size);

/* Makes a shape from a triangle mesh in arrays. Dirty meshes (open, self-intersecting, flipped,
 * duplicate triangles) are accepted and diagnosed by msq_shape_info.
 *
 * Membership: a point of the mesh's bounding box is inside where the winding number of the +x ray
 * from it satisfies the winding rule. Crossings are half-open in y and z, so shared edges and
 * vertices count once, and closed in x: a point on a crossing is inside if either side of it is. So
 * points exactly on a face that is highest in y or z are outside, those on the opposite face inside.
 * Limits: coordinates up to 1e100, 2^32 - 1 vertices and triangles. Cost: linear in the triangles,
 * about 100 bytes for each are kept.
 * Errors: ARGUMENT, MESH (no triangles, index out of range, triangle with a non-finite vertex), LIMIT, MEMORY. */
MSQ_API msq_status msq_shape_from_mesh(msq_context *context, const msq_mesh_def *def,
                                       msq_shape **shape);

/* Axis-aligned box, boundary included, in model units up to 1e75. Errors: ARGUMENT unless min < max in
 * each axis; MEMORY. */
MSQ_API msq_status msq_shape_from_box(msq_context *context, const double min[3],
                                      const double max[3], msq_shape **shape);
/* Ball, boundary included, in model units up to 1e75. Errors: ARGUMENT unless radius > 0; MEMORY. */
MSQ_API msq_status msq_shape_from_sphere(msq_context *context, const double center[3],
                                         double radius, msq_shape **shape);
/* Flat-ended round cylinder between two points, boundary included, in model units up to 1e75. Errors: ARGUMENT unless the
 * points differ and radius > 0; MEMORY. */
MSQ_API msq_status msq_shape_from_cylinder(msq_context *context, const double from[3],
                                           const double to[3], double radius, msq_shape **shape);

/* inside[i] = 0 where point i is outside, any other value where it is inside or on the boundary. */
typedef int32_t (*msq_inside_fn)(void *user, const double *points, uint64_t count,
                                 uint8_t *inside);

typedef struct msq_host_shape_def {
  uint32_t struct_size;
  int32_t concurrent;     /* 0 (default) or 1: see "objects that the host defines" */
  msq_inside_fn inside;   /* of points in the box, in model coordinates */
  msq_values_fn distance; /* of any points: at most the distance to the boundary, on either side of it,
                             and changing by no more than the points do; the sign is nothing.
                             NULL (default): the distance to the box */
  void *user;
  msq_release_fn release;
  double min[3], max[3];  /* box outside of which nothing is inside. No default: must be set */
} msq_host_shape_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_host_shape_def_init(msq_host_shape_def *def, size_t size);

/* Shape that the host computes: the points of a box, up to 1e75 in model units, that its callback
 * finds inside. Slices and arrays of points ask in batches, distances point by point. def may not be
 * NULL. Errors: ARGUMENT unless min < max in each axis; MEMORY; of calls that ask the shape, HOST. */
MSQ_API msq_status msq_shape_from_host(msq_context *context, const msq_host_shape_def *def,
                                       msq_shape **shape);

enum { /* which side of an image's threshold is solid; the threshold itself is, too */
  MSQ_SOLID_ABOVE = 0,
  MSQ_SOLID_BELOW = 1
};

typedef struct msq_voxels_def {
  uint32_t struct_size;
  int32_t solid;    /* MSQ_SOLID_*; default ABOVE */
  msq_image image;  /* at least 2 values along each axis */
  double threshold; /* in the unit of the values (default 0) */
} msq_voxels_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_voxels_def_init(msq_voxels_def *def, size_t size);

/* Makes a shape from a voxel image, such as a CT scan: the points where the trilinear function between
 * its values is on the solid side of the threshold, within the box that the outermost values span. A
 * solid that reaches the image's border ends there. def may not be NULL. Limits: coordinates up to 1e75.
 * Cost: linear in the values, on the calling thread (a second or two for 10^8); rows and layers ask
 * little more than the cells that the surface crosses.
 * Errors: ARGUMENT (also where no value is solid), LIMIT (the image would pass the context's
 * memory_limit), MEMORY. */
MSQ_API msq_status msq_shape_from_voxels(msq_context *context, const msq_voxels_def *def,
                                         msq_shape **shape);

MSQ_API void msq_shape_retain(msq_shape *shape);
MSQ_API void msq_shape_release(msq_shape *shape);

typedef struct msq_shape_report {
  uint32_t struct_size;
  int32_t is_mesh;     /* 1 for meshes; 0 for others, whose counts below are 0 */
  double min[3];       /* bounding box */
  double max[3];
  double volume;       /* cubic model units; meshes: signed sum over triangles, exact for closed
                          ones but for rounding, negative if inside out; voxels: by counting solid
                          values, each the part of its spacing's box that is in the image; NaN of a
                          host's shape */
  double area;         /* square model units; NaN of voxels and of a host's shape */
  uint64_t vertices;             /* after welding */
  uint64_t triangles;            /* kept */
  uint64_t degenerate_triangles; /* without area. Those with fewer than three distinct vertices are
                                    dropped, collinear ones kept: they close the surface */
  uint64_t duplicate_triangles;  /* kept: same three vertices as an earlier one */
  uint64_t open_edges;           /* with one triangle */
  uint64_t non_manifold_edges;   /* with three or more */
  uint64_t flipped_edges;        /* with two triangles that run along it the same way */
  int32_t closed;                /* 1 if every edge has as many triangles one way as the other */
  int32_t reserved;              /* 0 */
} msq_shape_report;

/* Bounds, volume, area and the diagnosis of a dirty mesh. Cost: none, found at construction.
 * Errors: ARGUMENT. */
MSQ_API msq_status msq_shape_info(const msq_shape *shape, msq_shape_report *report);

/* Counts the pairs of triangles in which a mesh intersects itself; 0 for other shapes. A pair counts
 * if its triangles meet other than in a vertex or an edge that both have: they cross, touch, overlap
 * in a plane or are duplicates, in the sense of CGAL::Polygon_mesh_processing::self_intersections.
 * Decided exactly, after welding; triangles without area are left out. A diagnosis only: meshes that
 * intersect themselves are shapes like others, and no answer of the shape depends on this.
 * Cost: about n log^3 n for n triangles and a test for each pair whose boxes meet, on the calling
 * thread (about a second for 270,000 triangles), and about 100 bytes a triangle meanwhile. job NULL:
 * none; its progress goes from 0 to 1 at the end.
 * Errors: ARGUMENT, CANCELLED, UNSUPPORTED (a mesh, in a build without CGAL), MEMORY.
 * Source: Zomorodian and Edelsbrunner, "Fast software for box intersections", 2002. */
MSQ_API msq_status msq_shape_self_intersections(const msq_shape *shape, uint64_t *pairs,
                                                msq_job *job);

/* ---- fields ----------------------------------------------------------------- */

typedef struct msq_field msq_field; /* a number at every point of space, of known range */

/* Field that runs linearly from from_value in the plane through from, normal to to - from, to
 * to_value in the plane through to, and is constant beyond both. Errors: ARGUMENT unless the points
 * differ, by 1e-140 at least, and the values by less than overflows; MEMORY. */
MSQ_API msq_status msq_field_gradient(msq_context *context, const double from[3],
                                      double from_value, const double to[3], double to_value,
                                      msq_field **field);

typedef struct msq_radial_field_def {
  uint32_t struct_size;
  uint32_t reserved;    /* 0 */
  double center[3];     /* default 0 */
  double axis[3];       /* of any length: distances count from the line along it through center;
                           0 (default): from center */
  double from_radius;   /* >= 0 (default 0) */
  double from_value;
  double to_radius;     /* > from_radius (default 1) */
  double to_value;
} msq_radial_field_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_radial_field_def_init(msq_radial_field_def *def, size_t size);

/* Field that runs linearly with the distance from a point or a line: from_value up to from_radius, to
 * to_value at to_radius and beyond. def may not be NULL. Errors: ARGUMENT, MEMORY. */
MSQ_API msq_status msq_field_radial(msq_context *context, const msq_radial_field_def *def,
                                    msq_field **field);

/* Field that is a piecewise linear curve over another field. curve: curve_count pairs (value of
 * argument, value of this field), 1 to 65536 of them, ascending in the first, constant beyond the
 * ends. Cost at a point: that of argument, and as log(curve_count). Errors: ARGUMENT, LIMIT (more than
 * 64 maps within each other), MEMORY. */
MSQ_API msq_status msq_field_map(msq_context *context, const msq_field *argument,
                                 const double *curve, uint64_t curve_count, msq_field **field);

typedef struct msq_host_field_def {
  uint32_t struct_size;
  int32_t concurrent;     /* 0 (default) or 1: see "objects that the host defines" */
  msq_values_fn evaluate; /* values at points of space, anywhere, in model coordinates */
  msq_range_fn range;     /* over a box in model coordinates; NULL (default): from lipschitz */
  void *user;
  msq_release_fn release;
  double low, high;       /* finite; no value is ever outside. No default: they must be set */
  double lipschitz;       /* no two values differ by more than this times the distance of their
                             points; infinity (default): unknown */
} msq_host_field_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_host_field_def_init(msq_host_field_def *def, size_t size);

/* Field that the host computes. def may not be NULL. What msq does with whole blocks of points rests on
 * the range over a box: without range and lipschitz it is low to high everywhere, which is right but slow
 * where the field varies. Where lipschitz or range promise too much, answers are wrong, no worse. Cost:
 * a point at a time in single queries and along struts, batches in sets and slices of functional
 * structures. Errors: ARGUMENT, MEMORY; of calls that ask the field, HOST. */
MSQ_API msq_status msq_field_host(msq_context *context, const msq_host_field_def *def,
                                  msq_field **field);
typedef struct msq_grid_field_def {
  uint32_t struct_size;
  uint32_t reserved; /* 0 */
  msq_image image;
} msq_grid_field_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_grid_field_def_init(msq_grid_field_def *def, size_t size);

/* Field that is an image: trilinear between its values, and beyond it what it is at the nearest point of
 * its border. Its Lipschitz constant is that of the steepest neighbours. def may not be NULL. Cost:
 * linear in the values, on the calling thread (a second for 10^8); at a point, nanoseconds. Errors:
 * ARGUMENT, LIMIT (the image would pass the context's memory_limit), MEMORY. */
MSQ_API msq_status msq_field_grid(msq_context *context, const msq_grid_field_def *def,
                                  msq_field **field);

typedef struct msq_named_value {
  const char *name; /* letters, digits and _, no digit first, and none that expressions know already */
  double value;
} msq_named_value;

typedef struct msq_expression_field_def {
  uint32_t struct_size;
  uint32_t reserved;                 /* 0 */
  const char *expression;            /* as in msq_structure_functional */
  const msq_named_value *parameters; /* parameter_count names that it may use */
  uint64_t parameter_count;          /* at most 1024 */
  double low, high;                  /* finite, low <= high (default 0); no value is ever outside */
} msq_expression_field_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_expression_field_def_init(msq_expression_field_def *def, size_t size);

/* Field that is an expression (msq_structure_functional says of what), cut to low and high; low where
 * it is no number. x, y and z are the model's coordinates, in its unit, not angles. def may not be NULL. A
 * Lipschitz constant is not known: distances to surfaces that depend on it are 0. Errors: ARGUMENT, LIMIT
 * (as msq_structure_functional), MEMORY. */
MSQ_API msq_status msq_field_expression(msq_context *context, const msq_expression_field_def *def,
                                        msq_field **field);

typedef struct msq_shape_distance_field_def {
  uint32_t struct_size;
  uint32_t reserved;     /* 0 */
  const msq_shape *shape;
  const double *curve;   /* curve_count pairs (signed distance, value), as in msq_field_map; distances are
                            negative inside */
  uint64_t curve_count;
  double step;           /* 0 (default): the distance itself at every point; > 0: samples of it this far
                            apart, trilinear between them */
} msq_shape_distance_field_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_shape_distance_field_def_init(msq_shape_distance_field_def *def, size_t size);

/* Field that is a piecewise linear curve over the signed distance to a shape, that of msq_point_distance: a
 * lower bound of its magnitude where the shape is dirty, voxels or the host's. def may not be NULL.
 * With a step the distance is sampled once over the shape's box, on the context's threads, and is what
 * it is at the box's border beyond it; it is off by less than the step times sqrt(3), and by far less away
 * from edges and middle surfaces. Cost: without a step that of msq_point_distance at every point and strut
 * that is asked (microseconds: slices of fine structures take many times longer); with one, as
 * msq_field_grid of 4-byte values. Errors: ARGUMENT, LIMIT (samples, or the mesh's tree, would pass
 * the context's memory_limit), HOST, MEMORY. */
MSQ_API msq_status msq_field_shape_distance(msq_context *context,
                                            const msq_shape_distance_field_def *def,
                                            msq_field **field);

MSQ_API void msq_field_retain(msq_field *field);
MSQ_API void msq_field_release(msq_field *field);

/* A parameter: the field, or the value where field is NULL. What is built with a field retains it. */
typedef struct msq_param {
  double value;
  const msq_field *field;
} msq_param;

/* ---- structures: scales 1 and finer -------------------------------------------- */

typedef struct msq_structure msq_structure; /* a fine-scale structure that fills all space */

enum { /* unit cells of strut lattices, by nodes and struts in the unit cube */
  MSQ_UNIT_CELL_CUSTOM = 0, /* nodes and struts of the definition */
  MSQ_UNIT_CELL_CUBIC = 1,  /* the cube's edges: 3 struts a cell */
  MSQ_UNIT_CELL_BCC = 2,    /* centre to the 8 corners */
  MSQ_UNIT_CELL_OCTET = 3,  /* corners to face centres, and the octahedron of face centres: 24 */
  MSQ_UNIT_CELL_FCC = 4,    /* the diagonals of the faces: 12 */
  MSQ_UNIT_CELL_KELVIN = 5, /* the edges of truncated octahedra that fill space: 24 */
  MSQ_UNIT_CELL_DIAMOND = 6, /* the bonds of the diamond crystal: 16 */
  MSQ_UNIT_CELL_RHOMBIC_DODECAHEDRON = 7, /* the edges of rhombic dodecahedra that fill space: 32 */
  MSQ_UNIT_CELL_REENTRANT = 8 /* uprights along z, 3/4 of the cell high, every second half a cell
                                 higher than those beside it, and slanted struts from their ends back
                                 to the ends of their four neighbours: 22. Auxetic: pulled along z it
                                 widens in x and y */
};

/* A unit cell by itself: a named one, or nodes and struts. */
typedef struct msq_unit_cell_def {
  uint32_t struct_size;
  int32_t unit_cell;      /* MSQ_UNIT_CELL_*; default BCC */
  const double *nodes;    /* CUSTOM: node_count triples in [0, 1] of the cell */
  uint64_t node_count;    /* at most 4096 */
  const uint32_t *struts; /* CUSTOM: strut_count pairs of node indices */
  uint64_t strut_count;   /* at most 4096; of a named cell needed with strut_factors alone */
  const double *strut_factors; /* of the radius, one a strut, 0.001 to 1000; NULL (default): all 1 */
} msq_unit_cell_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_unit_cell_def_init(msq_unit_cell_def *def, size_t size);

typedef struct msq_unit_cell_report {
  uint32_t struct_size;
  int32_t is_periodic;        /* 1 if unmatched_count is 0 */
  uint64_t node_count;        /* of the definition, or of the named cell */
  uint64_t strut_count;
  uint64_t tiled_strut_count; /* struts a cell of the tiling: those whole cells apart count once */
  double tiled_length;        /* of these, in a cell of size 1 */
  uint64_t low_nodes[3];      /* nodes on the face at 0 of each axis */
  uint64_t high_nodes[3];     /* and on that at 1 */
  uint64_t unmatched_nodes[3]; /* of both, those without a copy on the opposite face */
  uint64_t unmatched_count;   /* nodes that have none along one axis or more */
} msq_unit_cell_report;

/* Counts the nodes and struts of a unit cell, and says which nodes on its faces meet those of the next
 * cell, wherever struts end; a cell that is not periodic may be used as any other, but its struts may
 * end there without joining another. unmatched: becomes the indices of the unmatched nodes, ascending,
 * the first unmatched_room of them; NULL if unmatched_room is 0. Nodes within 1e-9 of the cell size
 * of each other are the same. Cost: the squares of the numbers of nodes and of struts, less than a
 * second. Errors: ARGUMENT, MEMORY. */
MSQ_API msq_status msq_unit_cell_info(const msq_unit_cell_def *cell, msq_unit_cell_report *report,
                                      uint32_t *unmatched, uint64_t unmatched_room);

/* Copies the nodes of a unit cell, node_count triples, and its struts, strut_count pairs of node
 * indices, into the host's arrays, in the order that strut_factors takes: to draw a named cell, or to
 * change it. The counts must be those of msq_unit_cell_info. Errors: ARGUMENT, MEMORY. */
MSQ_API msq_status msq_unit_cell_geometry(const msq_unit_cell_def *cell, double *nodes,
                                          uint64_t node_count, uint32_t *struts,
                                          uint64_t strut_count);

typedef struct msq_lattice_def {
  uint32_t struct_size;
  int32_t unit_cell;      /* MSQ_UNIT_CELL_*; default BCC */
  msq_neighbourhood grid;
  msq_param radius;       /* of the struts, in model units; constant: > 0, field: >= 0, nowhere
                             negative. No default: it must be set */
  const double *nodes;    /* CUSTOM: node_count triples in [0, 1] of the cell */
  uint64_t node_count;    /* at most 4096 */
  const uint32_t *struts; /* CUSTOM: strut_count pairs of node indices */
  uint64_t strut_count;   /* at most 4096 */
  const double *strut_factors; /* as in msq_unit_cell_def */
  const msq_unit_cell_def *cells; /* NULL (default): the unit cell above; else a library of cell_count
                             of them, all of one struct_size, and unit_cell does not count. Together
                             at most 4096 nodes and 4096 struts */
  uint32_t cell_count;    /* 1 to 256 */
  uint32_t clusters;      /* parts along each axis into which the cell is divided, without a library,
                             to find the struts near points of arrays: 1 (none) to 64; 0 (default):
                             as many as pay. Same results at any number */
  msq_param cell_choice;  /* which of the library stands in each neighbourhood cell: its value at the
                             cell's centre, rounded to the nearest index, half up, and kept within
                             the library */
} msq_lattice_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_lattice_def_init(msq_lattice_def *def, size_t size);

/* Periodic strut lattice: the points within radius, times the strut's factor, of the unit cell's
 * struts, tiled without end. Struts are capsules: round at their ends, circular in model units
 * whatever the cell sizes, and they reach over cell borders. With a library, each cell holds the
 * struts of the unit cell that the choice names there, and struts reach over borders likewise; where
 * the nodes of two unlike cells do not match (msq_lattice_faces), struts end at the face. def may not
 * be NULL. Cost: as the struts that can reach one cell;
 * milliseconds for the presets, seconds for thousands of struts as wide as cells, and as much again for the first array or distance. Errors: ARGUMENT, LIMIT (radius times the greatest factor above 4 times the smallest cell
 * size, too large a library), MEMORY. */
MSQ_API msq_status msq_structure_lattice(msq_context *context, const msq_lattice_def *def,
                                         msq_structure **structure);

typedef struct msq_lattice_faces_report {
  uint32_t struct_size;
  int32_t axis;         /* of the first unmatched face: 0, 1, 2: normal to x, y, z of the grid; -1:
                           there is none, and the fields below are 0 */
  uint64_t cells;       /* looked at */
  uint64_t faces;       /* between two of them with different unit cells of the library */
  uint64_t unmatched;   /* of these faces, with a node on one side that has no copy on the other */
  int32_t cell[3];      /* index of the cell below the first unmatched face; the other is the next
                           along the axis. First: cells taken by z, then y, then x */
  uint32_t reserved;    /* 0 */
  uint32_t types[2];    /* what stands in the two cells, as indices in the library */
  double point[3];      /* centre of the face, in model units */
} msq_lattice_faces_report;

/* Says how many faces between neighbouring cells of a lattice have unit cells on either side whose
 * nodes there do not match, and where the first is. The cells are those that the box from min to max,
 * in model units, has inner points in (msq_model_bounds: those of a model); on turned grids those of
 * its bounding box along the grid's axes. A lattice without a library has no such faces:
 * msq_unit_cell_info tells whether it is periodic. job NULL: none. Cost: asks the choice once a cell, a byte for each cell of a layer.
 * Errors: ARGUMENT (also: a structure that is no lattice), CANCELLED, LIMIT (more than 2^30 cells, or 2^24 from the
 * grid's origin), MEMORY. */
MSQ_API msq_status msq_lattice_faces(const msq_structure *lattice, const double min[3],
                                     const double max[3], msq_lattice_faces_report *report,
                                     msq_job *job);

/* How the points of sets, grids and slices are answered: the same solid, at different cost. Single
 * points (msq_point_membership) are answered by the definition whatever the method. POINT, METHOD_1
 * and METHOD_2 are those of the paper, for comparison; their times are those of cubic cells, r = 0.1
 * cell, one thread, and grow fast with r. */
enum {
  MSQ_FOAM_AUTO = 0,     /* the fastest: at present DIRECT */
  MSQ_FOAM_POINT = 1,    /* the paper's naive query, each point by itself: gather seeds, triplets with
                            the nearest, projection, validity; about 0.2 ms a point */
  MSQ_FOAM_METHOD_2 = 2, /* per cell, the edges of a Delaunay triangulation (CGAL) kept in the cache;
                            about 0.5 ms a cell and 0.3 us a point */
  MSQ_FOAM_DIRECT = 3,   /* each edge built once, kept in the cache and written as spans; arrays of
                            points, and grids of few samples a cell, by the seeds near each point,
                            grouped by cell and in vectors */
  MSQ_FOAM_METHOD_1 = 4  /* per cell, the lines of triplets of seeds kept in the cache, validity
                            tested per point; about 0.04 ms a cell and 0.3 us a point */
};

typedef struct msq_foam_def {
  uint32_t struct_size;
  int32_t method;         /* MSQ_FOAM_* */
  msq_neighbourhood grid;
  msq_param radius;       /* of the struts, in model units; constant: > 0, field: >= 0, nowhere
                             negative. No default: it must be set */
  double jitter;          /* 0: seeds at cell centres; 1 (default): anywhere in their cells */
  uint64_t seed;          /* any number picks another foam (default 0) */
  msq_param density;      /* seeds in a cell's volume, 0 to 32768; below 1 counts as 1 (default) */
} msq_foam_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_foam_def_init(msq_foam_def *def, size_t size);

/* Open-cell Voronoi foam: the points within radius of the edges of the Voronoi diagram of one
 * jittered seed per neighbourhood cell, all space over. Struts are capsules, circular in model
 * units. Seeds follow from cell index and seed number alone, on every machine alike. Where density
 * is above 1, cells are refined 2x2x2, recursively, one jittered seed a leaf, to that density on
 * average (docs/concepts.md has the rule). def may not be NULL. Cost: none; cells are built by the
 * calls that need them. Errors: ARGUMENT, LIMIT (radius above the smallest cell size, cell sizes
 * that differ by more than 4 times, density above 32768), UNSUPPORTED (METHOD_2 without CGAL;
 * others than AUTO and DIRECT with a density above 1), MEMORY.
 * Source: paper, section "Preprocessing for Voronoi Foams"; Martinez, Dumas and Lefebvre 2016. */
MSQ_API msq_status msq_structure_foam(msq_context *context, const msq_foam_def *def,
                                      msq_structure **structure);

enum { /* functions of functional structures; x, y, z: 2 pi times the position within the cell */
  MSQ_FUNCTION_EXPRESSION = 0, /* the text of the definition */
  MSQ_FUNCTION_GYROID = 1,     /* sin x cos y + sin y cos z + sin z cos x */
  MSQ_FUNCTION_SCHWARZ_P = 2,  /* cos x + cos y + cos z */
  MSQ_FUNCTION_DIAMOND = 3,    /* sin x sin y sin z + sin x cos y cos z + cos x sin y cos z
                                  + cos x cos y sin z */
  MSQ_FUNCTION_I_WP = 4,       /* 2 (cos x cos y + cos y cos z + cos z cos x)
                                  - (cos 2x + cos 2y + cos 2z) */
  MSQ_FUNCTION_NEOVIUS = 5,    /* 3 (cos x + cos y + cos z) + 4 cos x cos y cos z */
  MSQ_FUNCTION_F_RD = 6,       /* 4 cos x cos y cos z
                                  - (cos 2x cos 2y + cos 2y cos 2z + cos 2z cos 2x) */
  MSQ_FUNCTION_LIDINOID = 7,   /* 0.5 (sin 2x cos y sin z + sin 2y cos z sin x + sin 2z cos x sin y)
                                  - 0.5 (cos 2x cos 2y + cos 2y cos 2z + cos 2z cos 2x) + 0.15 */
  MSQ_FUNCTION_SPLIT_P = 8     /* 1.1 (sin 2x sin z cos y + sin 2y sin x cos z + sin 2z sin y cos x)
                                  - 0.2 (cos 2x cos 2y + cos 2y cos 2z + cos 2z cos 2x)
                                  - 0.4 (cos 2x + cos 2y + cos 2z) */
};

enum {
  MSQ_FUNCTIONAL_NETWORK = 1, /* solid where the function is at most the level */
  MSQ_FUNCTIONAL_SHEET = 2    /* solid where its magnitude is at most the level */
};

typedef struct msq_functional_def {
  uint32_t struct_size;
  int32_t function;       /* MSQ_FUNCTION_*; default GYROID */
  int32_t kind;           /* MSQ_FUNCTIONAL_*; default NETWORK */
  uint32_t clusters;      /* parts along each axis into which the cell is divided to answer whole
                             blocks at once: 1 (none) to 64; 0 (default): as many as pay. Same
                             results at any number */
  msq_neighbourhood grid; /* one period a cell */
  msq_param level;        /* a number as the function gives it, not a length (default 0); of a sheet:
                             constant > 0, field nowhere negative nor 0 everywhere, or thickness */
  const char *expression; /* EXPRESSION: text as below; else NULL */
  const msq_named_value *parameters; /* EXPRESSION: parameter_count names that it may use */
  uint64_t parameter_count;          /* at most 1024 */
  msq_param thickness; /* SHEET, instead of level: mean thickness of the walls, model units; constant > 0,
                          field nowhere negative nor 0 everywhere; default 0: level counts */
} msq_functional_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_functional_def_init(msq_functional_def *def, size_t size);

/* Functional structure: the points where a function of the position within the cell is at most the
 * level. def may not be NULL.
 *
 * Expressions are made of numbers, pi, parameters, x, y, z, + - * / ^, brackets, and pow(a, b),
 * min(a, b), max(a, b), abs, sqrt, sin, cos, exp and log (natural). ^ binds tighter than a sign
 * before it and groups to the right. x, y and z are angles, 2 pi times the position within the cell
 * in cell sizes, 0 to 2 pi: a function that does not repeat by itself is made to, and jumps at the
 * cell's border. Powers with whole constant exponents up to 65536 are products; others exp(b log(a)), so
 * of a > 0. Where the value is no number (as sqrt(-1), 0 / 0) the point is outside. At most 4096 bytes,
 * 100 brackets, signs and exponents within each other, 1024 different operations.
 *
 * Thickness is the walls' volume over the area of their middle surface, where the function is 0, both
 * in one cell; its level is read off a curve of 512 pieces that 65^3 values of the function give, good to
 * about 0.3 % of the thickness for the named functions (docs/concepts.md). Walls are thicker where the
 * function is flatter. A field of thicknesses means at each point the level of that thickness.
 *
 * Functions are computed of IEEE operations alone, not by the C library: the same bits on every machine.
 * Cost: none; the first slice or grid takes clusters^3 evaluations in intervals (tens of milliseconds by
 * default; seconds for the longest expressions in 64^3 clusters); a thickness takes some tens of milliseconds at once.
 * Errors: ARGUMENT (thickness for a network, together with a level, or above what fills the cell; of a
 * function that has no 0, or is nowhere more than 1e-300; for expressions the message has the position, from 1, and the reason), LIMIT (expressions
 * too long, too deep, with too many operations), MEMORY.
 * Source: paper, section "Preprocessing for Repeating Structures"; Schoen 1970; von Schnering and
 * Nesper 1991. */
MSQ_API msq_status msq_structure_functional(msq_context *context, const msq_functional_def *def,
                                            msq_structure **structure);

/* Points as a structure of the host sees them: valid until the callback returns. */
typedef struct msq_host_points {
  uint32_t struct_size;    /* out: sizeof(msq_host_points) of the library */
  uint32_t reserved;
  uint64_t count;          /* at most 4096 */
  const double *points;    /* triples x, y, z in model coordinates */
  const double *positions; /* triples: from the corner of the point's cell, in model units along the
                              grid's axes; each from 0 to the cell size */
  const int32_t *cells;    /* triples i, j, k: the cell that each point lies in */
} msq_host_points;

/* inside[i] = 0 where point i is outside, any other value where it is inside or on the boundary. */
typedef int32_t (*msq_points_inside_fn)(void *user, const msq_host_points *points,
                                        uint8_t *inside);

/* distances[i]: at most the distance from point i to the boundary, on either side of it, and changing
 * by no more than the points do; the sign is nothing. */
typedef int32_t (*msq_points_distance_fn)(void *user, const msq_host_points *points,
                                          double *distances);

/* *data: what is to be known of a cell, NULL where that is nothing; *bytes: its size in memory. */
typedef int32_t (*msq_build_cell_fn)(void *user, const int32_t cell[3], void **data,
                                     uint64_t *bytes);

/* As msq_points_inside_fn, of points that all lie in one cell, whose data this is. */
typedef int32_t (*msq_evaluate_cell_fn)(void *user, const void *data,
                                        const msq_host_points *points, uint8_t *inside);

/* Frees data that is not NULL. */
typedef void (*msq_free_cell_fn)(void *user, void *data);

enum { /* what is known of all points of a box */
  MSQ_BOX_MIXED = 0,
  MSQ_BOX_OUTSIDE = 1,
  MSQ_BOX_INSIDE = 2
};

/* *answer: MSQ_BOX_* of the box from min to max, boundary included, in model coordinates; MIXED where
 * it is not known. */
typedef int32_t (*msq_box_fn)(void *user, const double min[3], const double max[3],
                              int32_t *answer);

typedef struct msq_host_structure_def {
  uint32_t struct_size;
  int32_t concurrent;                 /* 0 (default) or 1: see "objects that the host defines" */
  msq_neighbourhood grid;
  msq_points_inside_fn inside;        /* this, or both of the next two, must be there; where all are,
                                         single points are asked of this one, sets of those */
  msq_build_cell_fn build_cell;
  msq_evaluate_cell_fn evaluate_cell;
  msq_free_cell_fn free_cell;         /* may be NULL, as what follows */
  msq_box_fn box;                     /* spares asking the points of boxes without boundary */
  msq_points_distance_fn distance;    /* NULL: 0, which is right and of no use to sphere tracing */
  void *user;
  msq_release_fn release;
} msq_host_structure_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_host_structure_def_init(msq_host_structure_def *def, size_t size);

/* Structure that the host computes; everything works with inside alone. def may not be NULL.
 *
 * Cells are built when points in them are asked about, once for as long as the context's cache keeps
 * them, else again; two threads may build the same cell at once. Those that the cache drops are freed
 * when the next is built, or with the structure. Neighbouring cells know nothing of each other:
 * what reaches from one into the other must be in the data of both.
 * Cost: sets, grids and slices ask in batches; with build_cell they are grouped by cell, and without
 * given in their own order. Single points and distances ask point by point.
 * Errors: ARGUMENT, MEMORY; of calls that ask the structure, HOST.
 * Source: paper, section "Multiscale Shape-Material Modeling API". */
MSQ_API msq_status msq_structure_host(msq_context *context, const msq_host_structure_def *def,
                                      msq_structure **structure);

typedef struct msq_host_function_def {
  uint32_t struct_size;
  int32_t concurrent;     /* 0 (default) or 1: see "objects that the host defines" */
  int32_t kind;           /* MSQ_FUNCTIONAL_*; default NETWORK */
  uint32_t clusters;      /* as in msq_functional_def; of no use without range and lipschitz */
  msq_neighbourhood grid; /* one period a cell */
  msq_param level;        /* as in msq_functional_def */
  msq_values_fn evaluate; /* of triples of angles, 2 pi times the position within the cell, 0 to 2 pi */
  msq_range_fn range;     /* over a box of angles, from -1e-9 to 2 pi + 1e-9; NULL (default): from
                             lipschitz */
  void *user;
  msq_release_fn release;
  double lipschitz;       /* no two values differ by more than this times the distance of their angles;
                             infinity (default): unknown */
} msq_host_function_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_host_function_def_init(msq_host_function_def *def, size_t size);

/* Functional structure, as msq_structure_functional, of a function that the host computes. It may be
 * infinite, but must be a number. Where range or lipschitz are given, blocks that are inside or outside
 * as a whole are answered without asking points. def may not be NULL. Cost: clusters^3 calls of range (32768
 * by default), and as many points of evaluate where lipschitz is given.
 * Errors: ARGUMENT, HOST, MEMORY; of calls that ask the structure, HOST.
 * Source: paper, section "Preprocessing for Repeating Structures". */
MSQ_API msq_status msq_structure_host_function(msq_context *context,
                                               const msq_host_function_def *def,
                                               msq_structure **structure);

MSQ_API void msq_structure_retain(msq_structure *structure);
MSQ_API void msq_structure_release(msq_structure *structure);

/* ---- materials --------------------------------------------------------------------- */

typedef struct msq_material msq_material; /* an id and named channels: density, modulus, colour ... */

enum { MSQ_MATERIAL_VOID = 0 }; /* id where a model is not */

typedef struct msq_channel {
  const char *name; /* 1 to 255 bytes */
  msq_param value;
} msq_channel;

typedef struct msq_material_def {
  uint32_t struct_size;
  uint32_t id;                 /* > 0; what it is for is the host's to say. No default: it must be set */
  const msq_channel *channels; /* channel_count, each name once */
  uint64_t channel_count;      /* at most 256 */
} msq_material_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_material_def_init(msq_material_def *def, size_t size);

/* Makes a material. def may not be NULL. Errors: ARGUMENT, MEMORY.
 * Source: paper, section "Multiscale Shape-Material Modeling API". */
MSQ_API msq_status msq_material_create(msq_context *context, const msq_material_def *def,
                                       msq_material **material);

/* Grades one material into another: each channel is (1 - f) times that of a plus f times that of b, f
 * being the fraction at the point, everywhere from 0 to 1. id > 0, of the blend. Errors: ARGUMENT (also
 * where one has a channel that the other lacks), LIMIT (more than 64 blends within each other, or of more
 * than 4096 materials, the same counted as often as it is asked), MEMORY. */
MSQ_API msq_status msq_material_blend(msq_context *context, uint32_t id, const msq_material *a,
                                      const msq_material *b, const msq_param *fraction,
                                      msq_material **material);
MSQ_API void msq_material_retain(msq_material *material);
MSQ_API void msq_material_release(msq_material *material);

/* ---- model ------------------------------------------------------------------------ */

typedef struct msq_model msq_model; /* a coarse shape and the structures that fill it, scale by scale */

typedef struct msq_scale_def {    /* {0} but for what is set: it may grow */
  const msq_shape *shape;         /* for scale 0, else NULL */
  const msq_structure *structure; /* for scales 1 and finer, else NULL */
  msq_param skin;                 /* thickness, in model units, of the solid skin that the scale leaves
                                     under the coarse surface; nowhere negative; 0: none. Not for
                                     scale 0 */
  const msq_material *material;      /* of what the scale resolves; NULL: as the next coarser scale */
  const msq_material *skin_material; /* of its skin; NULL: as material. Not for scale 0 */
} msq_scale_def;

typedef struct msq_model_def {
  uint32_t struct_size;
  uint32_t scale_count;        /* 1 to 64 */
  const msq_scale_def *scales; /* coarsest first: a shape, then structures */
  uint32_t scale_size;         /* sizeof(msq_scale_def) of the caller; 0 (default): that of 0.1 */
  uint32_t reserved;           /* 0 */
} msq_model_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_model_def_init(msq_model_def *def, size_t size);

/* Makes the model whose solid is the intersection of its scales: of the shape with each structure
 * or, where the scale leaves a skin, with the structure and the skin together. The skin holds the
 * points of the shape whose depth, the distance to its boundary as in msq_point_distance, is at
 * most the skin's thickness at the point, where that is above 0. def may not be NULL.
 * Cost: none; with a skin, the first call that asks it builds the tree of a mesh's triangles.
 * Errors: ARGUMENT, LIMIT (the shape reaches 2^24 cells of a structure from its grid's origin),
 * UNSUPPORTED (a skin in a shape that does not know depths), MEMORY.
 * Source: paper, section "Multiscale Shape-Material Modeling API"; the skin is ours. */
MSQ_API msq_status msq_model_create(msq_context *context, const msq_model_def *def,
                                    msq_model **model);
MSQ_API void msq_model_retain(msq_model *model);
MSQ_API void msq_model_release(msq_model *model);

/* Bounding box of the coarse shape, which holds the model. Errors: ARGUMENT. */
MSQ_API msq_status msq_model_bounds(const msq_model *model, double min[3], double max[3]);

/* Characteristic length of a scale: its largest cell size; infinite for scale 0.
 * Errors: ARGUMENT (no such scale). */
MSQ_API msq_status msq_model_scale_length(const msq_model *model, uint32_t scale, double *length);

/* ---- queries ------------------------------------------------------------------------ */

enum { /* how a structure is asked about the points of a set: the same answers, at different cost */
  MSQ_QUERY_AUTO = 0,  /* by sets, and point by point where a group has few points */
  MSQ_QUERY_POINT = 1, /* each point by itself */
  MSQ_QUERY_SET = 2    /* groups of points that lie close together at once, however small */
};

typedef struct msq_query_def {
  uint32_t struct_size;
  int32_t method;      /* of msq_set_membership: MSQ_QUERY_*; default AUTO */
  double length_scale; /* scales whose characteristic length is at least this are resolved; finer
                          ones are taken as solid. 0 (default): all are resolved; infinity: the
                          coarse shape alone */
  uint64_t critical_count; /* AUTO: points that a group must have at least to be asked as a set; 0
                              (default): as measured for each kind of structure */
  uint32_t group_parts;    /* parts of a cell along each axis that arrays are grouped by, where parts hold
                              hundreds of points: 1 (by cell) to 64, rounded down to a power of 2; 0
                              (default): as measured. Same results at any number */
  uint32_t reserved;       /* 0 */
} msq_query_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_query_def_init(msq_query_def *def, size_t size);

enum { MSQ_POINTS_ARRAY = 1, MSQ_POINTS_GRID = 2, MSQ_POINTS_STRATIFIED = 3 };

typedef struct msq_points_def {
  uint32_t struct_size;
  int32_t kind;            /* MSQ_POINTS_* */
  /* ARRAY: any points, in any order */
  const void *coordinates; /* count triples x, y, z, at any address */
  uint64_t count;
  uint64_t stride;         /* bytes from one point to the next; 0 (default): tightly packed */
  int32_t coordinate_type; /* MSQ_FLOAT32 or MSQ_FLOAT64 (default) */
  uint32_t reserved;       /* 0 */
  /* GRID: point (i, j, k) is origin + (i, j, k) * spacing, and has index i + nx * (j + ny * k) */
  double origin[3];
  double spacing[3];       /* > 0 */
  uint64_t counts[3];      /* nx, ny, nz, each 1 to 2^31 - 1 */
  /* STRATIFIED: per_cell random points, uniform, in each cell of a box of nx * ny * nz cells. Cell
     (i, j, k) has its corner at origin + rotation * ((i, j, k) * spacing) and measures spacing; its
     point s has index s + per_cell * (i + nx * (j + ny * k)). Points follow from their index and the
     seed alone, on every machine alike, and are never stored */
  uint64_t seed;           /* any number picks another sample (default 0) */
  uint32_t per_cell;       /* at least 1 (default); at least 2 for standard errors */
  uint32_t reserved2;      /* 0 */
  double rotation[9];      /* as in msq_neighbourhood (default identity) */
} msq_points_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_points_def_init(msq_points_def *def, size_t size);

/* Writes points first .. first + count - 1 of a set, of any kind, as count triples x, y, z into
 * coordinates: the very numbers that queries of the set see. Cost: about 5 ns a point, on the calling
 * thread; call for ranges from several threads for more. Errors: ARGUMENT (also points past the set's end).
 * Source: paper, section "Structured and Unstructured Set Queries"; Steele, Lea and Flood 2014 (SplitMix64). */
MSQ_API msq_status msq_points_generate(const msq_points_def *points, uint64_t first, uint64_t count,
                                       double *coordinates);

/* Membership of one point: *inside becomes 1 in the model or on its boundary (for meshes see
 * msq_shape_from_mesh), else 0. query NULL: defaults. This is the definition that all other paths agree with bit for bit
 * (MSQ_FOAM_METHOD_2 at jitters below 0.01: outside 1e-9 of a cell about the boundary).
 * Cost: a mesh tests the triangles that share its y, z bin; a lattice the struts that can reach the
 * cell; a foam gathers 27 to a few hundred seeds (about a microsecond). Errors: ARGUMENT, MEMORY. */
MSQ_API msq_status msq_point_membership(const msq_model *model, const double point[3],
                                        const msq_query_def *query, int32_t *inside);

/* Membership of a set of points: inside[i] becomes 1 or 0 for point i. inside_count: length of that
 * array, which must be the number of points. query, job NULL: defaults, no job. Scale by scale, from
 * the coarsest; points that a scale answers are not asked of finer ones (msq_job_info counts them).
 * On ARGUMENT and LIMIT nothing is written; on CANCELLED and MEMORY inside may be partly written.
 * Cost: arrays as their points, each as in msq_point_membership but in parallel; in foams points are
 * grouped by cell first, whatever their order, and cost far less each. Memory for that: 6 bytes a
 * point, at most 15 MB; less where the memory limit leaves no room. Grids as slices, far less a point.
 * Stratified samples come grouped as they are, and need no such memory.
 * Errors: ARGUMENT (also non-finite points, by index), CANCELLED, LIMIT, MEMORY.
 * Source: paper, section "Set-based queries". */
MSQ_API msq_status msq_set_membership(const msq_model *model, const msq_points_def *points,
                                      const msq_query_def *query, uint8_t *inside,
                                      uint64_t inside_count, msq_job *job);

/* Material of one point: *id becomes that of its material, MSQ_MATERIAL_VOID outside the model, and
 * values[c], of channel_count, the value there of the channel called channels[c]; 0 outside, and where
 * the material has no such channel. The material is that of the finest resolved scale that has one, or
 * of its skin within it: what stands for structures that are not resolved is the material of the
 * scale that they fill, which the host gives as it is on the whole. channels and values may be NULL
 * where channel_count is 0; query NULL: defaults. Errors: ARGUMENT (also where no resolved scale has a
 * material, or none of their materials a channel of that name), MEMORY.
 * Source: paper, section "Multiscale Shape-Material Modeling API". */
MSQ_API msq_status msq_point_material(const msq_model *model, const double point[3],
                                      const msq_query_def *query, const char *const *channels,
                                      uint64_t channel_count, uint32_t *id, double *values);

/* Materials of a set of points: ids[i] and values[i * channel_count + c] become, bit for bit, what
 * msq_point_material answers for point i. id_count: length of ids, the number of points; value_count: that
 * of values, channel_count times as many. query, job NULL: defaults, no job. On ARGUMENT and LIMIT nothing
 * is written; on CANCELLED and MEMORY the arrays may be partly written. Cost: membership as in
 * msq_set_membership and a byte a point for it; channels of the points inside, a few thousand at
 * a time. Errors: ARGUMENT (also non-finite points, by index), CANCELLED, LIMIT, MEMORY.
 * Source: paper, section "Set-based queries". */
MSQ_API msq_status msq_set_material(const msq_model *model, const msq_points_def *points,
                                    const msq_query_def *query, const char *const *channels,
                                    uint64_t channel_count, uint32_t *ids, uint64_t id_count,
                                    double *values, uint64_t value_count, msq_job *job);

/* Signed distance of one point to the model's boundary, in model units: *distance becomes positive
 * (at least 2.2e-308) where msq_point_membership answers 0, and 0 or negative where it answers 1.
 * Always finite. query NULL: defaults.
 *
 * Its magnitude never exceeds the distance to the boundary of the resolved model, so a step of that
 * length along a ray crosses no surface. It is that of one scale: of the coarsest that the point is
 * outside of; where it is inside all, of the nearest of their boundaries.
 * - Box, ball and cylinder: exact, on both sides.
 * - Meshes: distance to the nearest triangle; exact where every triangle bounds the solid, as in
 *   clean meshes, else a bound. With open edges, rays of msq_shape_from_mesh that pass a hole bound
 *   the solid too: distances to what they sweep, from the hole towards lower x, count as well.
 * - Voxel images: a bound, short by less than the diagonal of a cell between eight values.
 * - Lattices and foams: exact outside for constant radius (lattices whose cell sizes differ by more
 *   than 8 times, 4 times with strut factors: within as many times the smallest; with a library of
 *   unit cells: within twice the smallest); inside a bound, the radius less the distance to the
 *   nearest axis. With a radius that is a field of Lipschitz constant L (msq_field_gradient: the
 *   difference of the values over the distance of the points) these are divided by 1 + L, L times the
 *   greatest strut factor.
 * - Skins: the difference of depth and thickness, divided by 1 + L; a scale that leaves one has the
 *   lesser of its structure's and its skin's distance.
 * - Functional structures: a bound on both sides, the difference of onset and level over G + L: G the
 *   greatest slope of the function over its cell, proven by intervals (0 to 30 % above the true one
 *   for the named functions), L the level's Lipschitz constant. Where a function does not repeat by
 *   itself, no more than the distance to the cell's border along that axis. Where its slope has no
 *   bound (poles, roots and logarithms that reach 0, x^y with y no whole number), 0.
 * - Points outside the coarse shape: distance to the shape, however far its structures are.
 * "Exact" is up to rounding, which is subtracted from the magnitude: 1e-13 of the distance and of
 * the coordinates (from the grid's origin, for structures), besides 1e-9 of the largest cell size for
 * foams, 1e-12 of it for lattices and, for meshes with needle-like triangles, up to 3e-7 of the
 * longest edge. The distance of each scale changes by no more than the distance between two points;
 * that of a model may jump where the scale that it is taken from changes.
 *
 * Cost: a mesh builds a tree of its triangles at the first call that asks it (n log n, seconds for
 * millions, and about 120 bytes each until the shape is freed) and then searches about log n of it; a
 * lattice, the struts that can be nearest; a foam, the edges of the seeds about (a few
 * microseconds); a functional structure takes some ten milliseconds at the first call for the greatest
 * slope. Errors: ARGUMENT, LIMIT (the mesh's tree would pass the context's memory_limit),
 * MEMORY. Source: paper, section "Multiscale Shape-Material Modeling API"; Hart, "Sphere tracing",
 * 1996, for the bound. */
MSQ_API msq_status msq_point_distance(const msq_model *model, const double point[3],
                                      const msq_query_def *query, double *distance);

/* Signed distances of a set of points: distance[i] becomes, bit for bit, what msq_point_distance
 * answers for point i. distance_count: length of that array, which must be the number of points.
 * query, job NULL: defaults, no job. On ARGUMENT and LIMIT nothing is written; on CANCELLED and MEMORY
 * distance may be partly written. Cost: as msq_point_distance, in parallel, and cheaper for foams
 * where points of a cell follow each other; the building of a mesh's tree is not interrupted.
 * Errors: ARGUMENT (also non-finite points, by index), CANCELLED, LIMIT, MEMORY.
 * Source: paper, section "Set-based queries". */
MSQ_API msq_status msq_set_distance(const msq_model *model, const msq_points_def *points,
                                    const msq_query_def *query, double *distance,
                                    uint64_t distance_count, msq_job *job);

/* ---- statistics --------------------------------------------------------------------------- */

/* An estimated number between 0 and 1. */
typedef struct msq_estimate {
  double value;
  double standard_error; /* from the spread within the sample's cells */
  double low, high;      /* interval that holds the true value with a probability of 95 % (Wilson) */
} msq_estimate;

/* Functions of this section take a sample of kind MSQ_POINTS_STRATIFIED with 2 to 4096 points a cell.
 * Its box is what is measured: model and structure are asked nowhere else, save at the far ends of
 * segments, which may lie outside of it. Outside the coarse shape all is void; a structure by itself is
 * measured by a model of it in a larger box. The error of n points falls at least as 1 / sqrt(n), with many small
 * cells faster. It is that of the sample alone: of another foam of the same kind, with another seed,
 * the value itself differs. The same sample gives the same bits, whatever the threads. Memory: a few MB. */

enum { MSQ_PHASE_SOLID = 1, MSQ_PHASE_VOID = 2 };

/* Volume fraction of a phase (MSQ_PHASE_*) in the sample's box. query, job NULL: defaults, no job. On
 * failure nothing is written. Cost: as msq_set_membership. Errors: ARGUMENT, CANCELLED, MEMORY.
 * Source: paper, section "Set-based queries"; Cochran, "Sampling Techniques", 1977, chapter 5. */
MSQ_API msq_status msq_volume_fraction(const msq_model *model, const msq_points_def *sample,
                                       const msq_query_def *query, int32_t phase,
                                       msq_estimate *estimate, msq_job *job);

typedef struct msq_segments_def { /* one segment of each length begins at each point of the sample */
  uint32_t struct_size;
  int32_t phase;         /* MSQ_PHASE_*; default SOLID */
  double direction[3];   /* of all segments, of any length but 0; 0, 0, 0 (default): each point has its
                            own, uniform over the sphere, a function of its index and the seed */
  const double *lengths; /* length_count lengths, finite, not negative, in any order */
  uint64_t length_count; /* 1 to 4096 */
  double step;           /* of msq_lineal_path, in model units; 0 (default): a 256th of the finest resolved cell
                            size, or of the longest length where that is less */
} msq_segments_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_segments_def_init(msq_segments_def *def, size_t size);

/* Two-point correlation S2: estimates[i] becomes the probability that both ends of a segment of length
 * i are in the phase; of length 0 it is the volume fraction. estimate_count must be length_count.
 * query, job NULL: defaults, no job. On failure nothing is written. Cost: msq_set_membership of the
 * sample, and for each length of those of its points that are in the phase.
 * Errors: ARGUMENT, CANCELLED, MEMORY.
 * Source: Torquato, "Random Heterogeneous Materials", 2002, section 2.2. */
MSQ_API msq_status msq_two_point_correlation(const msq_model *model, const msq_points_def *sample,
                                             const msq_query_def *query,
                                             const msq_segments_def *def, msq_estimate *estimates,
                                             uint64_t estimate_count, msq_job *job);

/* Lineal-path function L: estimates[i] becomes the probability that a segment of length i lies wholly in the
 * phase. Segments are followed by steps as long as msq_point_distance allows, which pass no
 * boundary, and near boundaries by def's step: gaps shorter than that may be missed, longer ones never are;
 * ends are found within a thousandth of it. Other arguments, failure and errors as in
 * msq_two_point_correlation, and LIMIT (a length above 10^6 steps). Cost: tens of distances a point,
 * as many as steps where the distance is 0. Source: Torquato 2002, section 2.4; Lu and Torquato 1992. */
MSQ_API msq_status msq_lineal_path(const msq_model *model, const msq_points_def *sample,
                                   const msq_query_def *query, const msq_segments_def *def,
                                   msq_estimate *estimates, uint64_t estimate_count, msq_job *job);

typedef struct msq_calibration_report {
  uint32_t struct_size;
  uint32_t reserved;     /* 0 */
  uint64_t samples;      /* points asked */
  double parameter;      /* the least that holds at least the target share of the points */
  msq_estimate fraction; /* volume fraction at that parameter */
  double most_fraction;  /* at the greatest parameter that the structure's kind allows */
} msq_calibration_report;

/* Finds the parameter (radius of struts, level of a function), everywhere the same, at which a structure
 * has a target volume fraction, 0 to 1, and the curve between the two: pair i says that parameters[i], in model
 * units, has the fraction fractions[i] = i / (pair_count - 1) * most_fraction; both ascend. They make
 * a field of radius from one of density (msq_field_map). The parameter that the structure was built
 * with plays no part. parameters, fractions: pair_count numbers (2 to 2^20), or NULL with pair_count 0. report NULL: not wanted.
 * sample: where to measure; NULL: 2 points in each of 64^3 parts of one cell (lattices, functional structures)
 * or of 16^3 cells (foams) from the grid's origin. job NULL: none. On failure nothing is written.
 * Cost: the onset of each point (lattices 0.1 us, foams 1.5 us, in parallel) and a sort; 16
 * bytes a point, accounted to the context. Errors: ARGUMENT, UNSUPPORTED (a kind without onset: mixed lattices, host structures),
 * CANCELLED, LIMIT (a target above most_fraction, memory), MEMORY. */
MSQ_API msq_status msq_structure_calibrate(msq_context *context, const msq_structure *structure,
                                           const msq_points_def *sample, double target,
                                           double *parameters, double *fractions,
                                           uint64_t pair_count, msq_calibration_report *report,
                                           msq_job *job);

/* ---- slicing ------------------------------------------------------------------------- */

typedef struct msq_slicer msq_slicer; /* a model and a plan of layers */

enum { /* what a layer holds: one sample a pixel, at its centre */
  MSQ_LAYER_BITS = 1, /* 1 bit a pixel, leftmost pixel in the high bit, as in PNG and PBM */
  MSQ_LAYER_BYTES = 2 /* 1 byte a pixel: 255 inside, 0 outside */
};

typedef struct msq_slicer_def {
  uint32_t struct_size;
  int32_t output;       /* MSQ_LAYER_*; default BITS */
  double pitch[2];      /* pixel size in x and y; 0 (default): from region and resolution */
  uint32_t resolution[2]; /* pixels in x and y; 0 (default): from region and pitch, rounded up */
  double layer_height;  /* > 0, unless layer_z lists them */
  uint64_t layer_count; /* 0 (default): from region and layer_height, rounded up */
  int32_t has_region;   /* 0 (default): the region is the model's bounding box, centred in the
                           pixels, and region_min and region_max must be 0; 1: the region below */
  uint32_t slab_layers; /* layers computed at once; 0 (default): as many whole cells of the finest
                           scale as make about 64 layers, at least one, and no more than 32 MiB; for
                           structures that gain nothing by so many, than 2 MiB a thread. Same
                           results at any number */
  double region_min[3]; /* corner of pixel (0, 0) and underside of layer 0 */
  double region_max[3]; /* needed where a count follows from it */
  const double *layer_z;  /* z of each layer, ascending; NULL (default): the middle of each layer,
                             region_min[2] + (index + 1/2) * layer_height */
  uint64_t layer_z_count;  /* then the number of layers */
  double length_scale;  /* as in msq_query_def */
} msq_slicer_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_slicer_def_init(msq_slicer_def *def, size_t size);

/* Plans the layers of a model, normal to z. def may not be NULL. Nothing is computed yet. Errors: ARGUMENT, LIMIT (more
 * than 2^31 - 1 pixels along a side or layers), MEMORY. */
MSQ_API msq_status msq_slicer_create(const msq_model *model, const msq_slicer_def *def,
                                     msq_slicer **slicer);
MSQ_API void msq_slicer_retain(msq_slicer *slicer);
MSQ_API void msq_slicer_release(msq_slicer *slicer);

typedef struct msq_slicer_report {
  uint32_t struct_size;
  uint32_t slab_layers; /* layers computed at once */
  uint32_t width;       /* pixels in x */
  uint32_t height;      /* pixels in y */
  uint64_t layer_count;
  uint64_t stride;      /* bytes from one row to the next, a multiple of 8 */
  uint64_t layer_bytes; /* stride * height */
  double origin[2];     /* x, y of the centre of pixel (0, 0) */
  double pitch[2];      /* pixel (i, j) is sampled at origin + (i, j) * pitch, as in a point grid */
} msq_slicer_report;

/* The plan as it came out. Errors: ARGUMENT. */
MSQ_API msq_status msq_slicer_info(const msq_slicer *slicer, msq_slicer_report *report);

/* z of a layer's samples. Errors: ARGUMENT (index out of range). */
MSQ_API msq_status msq_slicer_layer_z(const msq_slicer *slicer, uint64_t index, double *z);

/* One layer as the callback sees it: valid until the callback returns. */
typedef struct msq_layer {
  uint32_t struct_size; /* out: sizeof(msq_layer) of the library */
  int32_t output;       /* MSQ_LAYER_* */
  uint64_t index;       /* in the plan */
  double z;
  const uint8_t *data;  /* height rows, row 0 at the smallest y; bits past the width are 0 */
  uint64_t stride;      /* bytes from one row to the next */
  uint32_t width, height;
  uint64_t inside_count; /* pixels inside */
} msq_layer;

/* Takes a layer. Return 0 to go on, a code of the host's own, best negative, to stop. Exceptions of the
 * host's language must not leave it: keep them, return a code, and raise them after the call. */
typedef int32_t (*msq_layer_fn)(void *user, const msq_layer *layer);

/* Computes layers first .. first + count - 1 and hands each to the callback, in ascending order, on
 * the calling thread; workers compute the next slab meanwhile, and wait for the callback. count
 * UINT64_MAX: to the last. job NULL: none. However the plan is split into calls or processes, the
 * layers are the same bytes. Memory: two slabs, a layer, and a few tiles for each thread, whatever the
 * height of the stack; foams keep cells in the cache besides. Errors: ARGUMENT, CANCELLED, HOST, LIMIT, MEMORY.
 * Source: paper, section "Slicing". */
MSQ_API msq_status msq_slicer_run(const msq_slicer *slicer, uint64_t first, uint64_t count,
                                  msq_layer_fn fn, void *user, msq_job *job);

/* Computes one layer, the same bytes as msq_slicer_run gives, into the host's buffer of
 * buffer_bytes >= layer_bytes. On failure the buffer is untouched. Cost: for many layers one after the
 * other, two to three times that of msq_slicer_run, which computes a slab at once.
 * Errors: ARGUMENT, CANCELLED, LIMIT, MEMORY. */
MSQ_API msq_status msq_slice_layer(const msq_slicer *slicer, uint64_t index, uint8_t *buffer,
                                   uint64_t buffer_bytes, msq_job *job);

/* ---- rays ---------------------------------------------------------------------------- */

typedef struct msq_rays_def {
  uint32_t struct_size;
  int32_t coordinate_type;   /* of origins and directions: MSQ_FLOAT32 or MSQ_FLOAT64 (default) */
  uint64_t count;
  const void *origins;       /* count triples x, y, z */
  const void *directions;    /* count triples, of any length but 0 */
  uint64_t origin_stride;    /* bytes from one to the next; 0 (default): tightly packed */
  uint64_t direction_stride;
  const double *t_min;       /* count numbers; NULL (default): 0 */
  const double *t_max;       /* count numbers, infinity allowed; NULL (default): infinity */
} msq_rays_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_rays_def_init(msq_rays_def *def, size_t size);

typedef struct msq_ray_hit {
  double t;             /* the point is origin + t * direction; infinity where nothing is hit */
  double normal[3];     /* outward, of length 1; against the ray where it starts inside; 0 in a miss */
  int32_t scale;        /* whose surface was hit, 0 the coarse shape's; -1: nothing was hit */
  int32_t starts_inside; /* 1: the ray is inside at t_min, and t is t_min; scale is the finest */
  int32_t cell[3];      /* of the finest resolved structure, at the point */
  uint32_t material;    /* id as msq_point_material has it just inside; MSQ_MATERIAL_VOID in a miss and
                           where no resolved scale has a material */
} msq_ray_hit;

/* Where each ray first is in the solid at t_min <= t <= t_max: hits[i] is of ray i. hit_count: length
 * of that array, which must be the number of rays. query, job NULL: defaults, no job.
 *
 * Membership (msq_point_membership) differs just before and just behind t, within 2^-36, about 1.5e-11, of
 * the characteristic length of the scale hit (of the shape: of its size and its coordinates), or within the
 * rounding of coordinates where that is more, some 1e5 cells from the origin, and changes nowhere before it
 * save for parts of the ray shorter than that, also where rays graze surfaces. Thinner parts than these may
 * be lost: 1/64 of the cell, in lattices and foams whose radius is a field without a Lipschitz constant
 * (expressions have one where they are smooth), in host structures without a distance and host functions
 * without a slope (lipschitz); 2^-10 of the cell, where an expression is no number along more of a ray than
 * about a tolerance, or may be unbounded there, or the level is a field whose ranges over small boxes stay
 * wide; 2^-24 of the cell, where a ray grazes a strut whose radius is a field that is not linear; 1/1024 of
 * its size, of a host's shape without a distance. Skins, hosts' shapes, along the faces of their cells voxel
 * images, and foams by rays far apart are followed by steps that their distance allows; where 64 of them lead
 * no farther than 1/64 of the cell (of the shape: of its size and its coordinates), as beside a surface that
 * the ray all but touches for long, the next are at least twice as long as before, and may lose thinner
 * parts.
 * Scale by scale: finer scales are asked only within the parts of the ray that lie in the coarser ones.
 * Of hosts' shapes, structures and functions a callback is asked for up to a thousand rays at once.
 *
 * Normals are exact, to rounding, on boxes, balls, cylinders, meshes, lattices and foams, on functional
 * structures to about 1e-8. Where the radius or level is a field that is not linear, and on host
 * functions that are smooth, they are known to about 1e-5. At the border of a cell over which
 * a function jumps the normal is that of the border. Elsewhere (voxel images, the inner faces of skins,
 * hosts' structures and shapes), and where rounding hides which strut was met, they are estimates, off
 * by 0.1 or so: the mean direction of those of 48 points close around that are outside.
 *
 * On ARGUMENT and LIMIT nothing is written; on CANCELLED and MEMORY hits may be partly written. Cost:
 * in parallel; rays that lie close together share their work. Where those that follow each other do not, up to
 * 2^20 at once are sorted first by where they come in and where they go, in 16 bytes each, at most 1/16 of the
 * context's memory_limit, and none where that has no room. Hits do not depend on it, but for rounding where
 * struts of a foam without jitter fall together or so far from the origin. A mesh builds its tree
 * first, as for msq_point_distance. Errors: ARGUMENT (also rays that are not finite, by index, and directions of
 * length 0), CANCELLED, LIMIT, MEMORY. Source: paper, section "Set Queries for Ray-Casting". */
MSQ_API msq_status msq_ray_cast(const msq_model *model, const msq_rays_def *rays,
                                const msq_query_def *query, msq_ray_hit *hits, uint64_t hit_count,
                                msq_job *job);

/* ---- cameras and pictures ------------------------------------------------------------ */

enum { MSQ_CAMERA_ORTHOGRAPHIC = 0, MSQ_CAMERA_PERSPECTIVE = 1 };

/* From where a model is seen. The view is the line from eye to target, in the middle of the picture. Depth is
 * the distance from the plane through eye that is normal to the view. docs/concepts.md has the formulas. */
typedef struct msq_camera {
  uint32_t struct_size;
  int32_t projection;    /* MSQ_CAMERA_*; default ORTHOGRAPHIC */
  double eye[3];         /* PERSPECTIVE: where all rays start; ORTHOGRAPHIC: a point of the plane where they do */
  double target[3];      /* not eye: both must be set */
  double up[3];          /* upwards in the picture, not along the view (default 0, 0, 1) */
  double height;         /* ORTHOGRAPHIC: model units from the picture's lower to its upper edge; must be set */
  double field_of_view;  /* PERSPECTIVE: angle between those edges in degrees, 0.001 to 179 (default 40) */
  double clip_near, clip_far; /* depths between which the model is seen, the rest being cut away;
                            0 <= near < far, defaults 0 and infinity */
} msq_camera;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_camera_init(msq_camera *camera, size_t size);

/* Sets eye, target, up and height so that the model's bounding box just fits a picture of width x height pixels
 * (1 to 16384 each), seen along `direction`, of any length but 0, from eye to target. The other fields stay and
 * must be set, as msq_camera_init does; in perspective field_of_view counts. up NULL: z, or y where z is
 * within 2.6 degrees of the view. On failure *camera stays as it was. Errors: ARGUMENT. */
MSQ_API msq_status msq_camera_fit(const msq_model *model, const double direction[3],
                                  const double up[3], uint32_t width, uint32_t height,
                                  msq_camera *camera);

/* The ray of a position in a picture of width x height pixels: position[0] pixels right and position[1] down
 * from its upper left corner; the middle of pixel (i, j) is (i + 0.5, j + 0.5). direction has such a length
 * that t of msq_ray_cast is the depth; from t_min = clip_near to t_max = clip_far the ray meets what
 * msq_render writes, to the last bit. For picking, and for pictures of the host's own. Errors: ARGUMENT. */
MSQ_API msq_status msq_camera_ray(const msq_camera *camera, uint32_t width, uint32_t height,
                                  const double position[2], double origin[3],
                                  double direction[3]);

/* What gives a surface its colour, before light falls on it. */
enum {
  MSQ_COLOUR_PLAIN = 0,    /* colours[0] */
  MSQ_COLOUR_SCALE = 1,    /* colours[scale % colour_count], as in msq_ray_hit */
  MSQ_COLOUR_MATERIAL = 2, /* colours[material id % colour_count] */
  MSQ_COLOUR_NORMAL = 3    /* red, green, blue = (1 + normal) / 2 */
};

typedef struct msq_render_def {
  uint32_t struct_size;
  uint32_t width, height;    /* pixels of the whole picture, 1 to 16384; must be set */
  uint32_t tile_x, tile_y;   /* the part to render: pixels from the upper left corner, */
  uint32_t tile_width, tile_height; /* and its size; all 0 (default): the whole. Tiles have the pixels of the
                                whole picture, to the last bit */
  uint32_t samples;          /* of rgba, along each side of a pixel, 1 (default) to 16: their mean */
  uint32_t first_step;       /* with a callback: 2, 4 .. 64: the first pass has one ray for each block of so
                                many pixels a side, then half as many; 1 (default): one for each pixel */
  int32_t colour_by;         /* MSQ_COLOUR_* */
  const double *colours;     /* colour_count triples red, green, blue, linear, 0 to 1; NULL (default): 8
                                colours of msq */
  uint64_t colour_count;     /* 1 to 65536 */
  double background[4];      /* red, green, blue, linear, and opacity, where nothing is hit; default 0 */
  double light[3];           /* direction to the light, of any length but 0, in the camera's frame: to the
                                right, upwards, towards the eye (default -0.4, 0.6, 1) */
  double ambient;            /* part of the light that comes from all around, 0 to 1 (default 0.3) */
  int32_t shadows;           /* 1: of the light, a ray for each sample in it; default 0 */
  uint32_t occlusion_rays;   /* for each sample, 0 (default) to 256: ambient light is what part of them, spread
                                by the cosine with the normal, meets nothing */
  double occlusion_distance; /* how far those reach, in model units; 0 (default): a tenth of the diagonal of
                                the model's bounding box */
} msq_render_def;

/* Sets defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_render_def_init(msq_render_def *def, size_t size);

/* Where pixels go: pixel (i, j) of the tile, j from the top down, to index j * row_pixels + i of each
 * array that is not NULL. All but rgba is of the ray through the pixel's middle. */
typedef struct msq_frame {
  uint32_t struct_size;
  uint32_t row_pixels; /* from one row to the next; 0 (default): the tile's width */
  float *depth;        /* infinity in a miss */
  float *normal;       /* 3 a pixel, as in msq_ray_hit, model frame; 0 in a miss */
  int32_t *scale;      /* as in msq_ray_hit; -1 in a miss */
  uint32_t *material;  /* as in msq_ray_hit */
  uint8_t *rgba;       /* 4 a pixel: red, green, blue in sRGB, and opacity, which they are not multiplied by */
} msq_frame;

/* Sets defaults: no arrays. Errors: ARGUMENT. */
MSQ_API msq_status msq_frame_init(msq_frame *frame, size_t size);

/* How far a picture has come. */
typedef struct msq_render_pass {
  uint32_t struct_size; /* out: sizeof(msq_render_pass) of the library */
  uint32_t step;        /* pixels along a side of the blocks that are of one ray yet; 1: each has its own */
  uint32_t samples;     /* of rgba, along a side of a pixel */
  int32_t is_last;      /* 1: the picture is done */
} msq_render_pass;

/* Takes a pass: the frame holds a whole picture, to be shown or copied, not to be changed before the last.
 * Return 0 to go on, a code of the host's own, best negative, to stop. Exceptions of the host's language must
 * not leave it. */
typedef int32_t (*msq_render_fn)(void *user, const msq_render_pass *pass);

/* Renders a model as a camera sees it. Depth, normal, scale and material of a pixel are what msq_ray_cast says
 * of the ray of its middle; its colour is the mean of its samples, each, in linear light, the background or
 *
 *   base * (ambient * open + (1 - ambient) * max(0, normal . light) * lit)
 *
 * where base is by colour_by, open the part of the occlusion rays that meet nothing, lit 0 in a shadow, and both
 * 1 where not asked for. What clip planes cut away is in no light's way. A pixel is the same, to the last bit,
 * whatever the tile, the passes and the threads; the directions of occlusion rays follow from a hash of pixel
 * and sample.
 *
 * fn NULL: not called. Otherwise it is called on the calling thread after each pass: of steps from first_step,
 * halved each time, to 1, of which each casts the rays that are new; then, where rgba wants more samples than
 * one, with all of them. query, job NULL: defaults, no job. On ARGUMENT nothing is written; on other errors the
 * frame may be partly written.
 *
 * Cost: a ray for each pixel, and samples^2 where those are more than one, to each of which shadows and
 * occlusion_rays add theirs; in parallel, by tiles of 32 x 32 rays. A mesh builds its tree first, as
 * for msq_point_distance. Memory: about 1 MB for each thread, kept for its next call.
 * Errors: ARGUMENT, CANCELLED, HOST, LIMIT, MEMORY. Source: paper, section "Set Queries for Ray-Casting". */
MSQ_API msq_status msq_render(const msq_model *model, const msq_camera *camera,
                              const msq_render_def *def, const msq_query_def *query,
                              const msq_frame *frame, msq_render_fn fn, void *user, msq_job *job);

#ifdef __cplusplus
}
#endif

#endif
