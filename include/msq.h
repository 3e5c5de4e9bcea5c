/* SPDX-License-Identifier: Apache-2.0 */
/** @file
 * msq ("multiscale set queries"): lattices, TPMS and Voronoi foams inside a part, without meshing
 * them.
 *
 * A host describes a coarse shape and the fine-scale structures that fill it. msq computes which
 * points are solid, returns layers for printing, casts rays and measures. The method is that of
 * Igouchkine and Liu, "Set-based queries for multiscale shape-material modeling". docs/concepts.md
 * defines all terms.
 *
 * These rules apply to every declaration:
 *
 * Units. Lengths are in the model's unit. Files are read in millimetres, so the unit of a model
 * that is made from a file is the millimetre. Coordinates are right-handed: x, y, z.
 *
 * Status. A function that can fail returns msq_status: MSQ_OK (0) or a negative MSQ_E_*.
 * msq_error_message() then returns a message with the offending value and its limit. A function
 * that fails writes no output argument, unless its comment says otherwise. A comment that lists
 * "Errors" names the statuses without their prefix.
 *
 * Handles. Handles are opaque, reference-counted and immutable. Any number of threads may use one
 * handle at the same time. A constructor returns a handle with one reference. X_retain adds a
 * reference. X_release drops one and frees the object with the last one. Retaining or releasing
 * NULL does nothing. A handle retains the handles that it was built from, so handles may be
 * released in any order, also from a callback. Build all parts of a model in one context: memory
 * and cached cells count against the context in which a part was created.
 *
 * Definitions. A definition is a struct that begins with struct_size. X_def_init(&def, sizeof def)
 * sets struct_size and all defaults, and writes no byte past the given size. If the struct is
 * larger than the library's, its excess bytes must be 0. Sizes too small for any version of the
 * struct and sizes above 4096 are refused.
 *
 * Reports. A report is a struct that msq fills in. The caller sets its struct_size. msq writes no
 * byte past that size, and sets bytes of unknown fields to 0. Sizes too small for any version of
 * the report and sizes above 4096 are refused.
 *
 * Inputs. A constructor copies the arrays and strings that it is given. NULL is refused unless the
 * comment gives it a meaning. A user pointer may be NULL. Outputs must not overlap inputs or each
 * other. Set queries and rays refuse outputs that overlap their inputs. A job may be NULL
 * everywhere: the call then reports no progress and cannot be cancelled. NaN is refused. Infinity
 * is refused unless the comment gives it a meaning.
 *
 * Threads. Every function may be called from any thread. Callbacks run on the thread that called
 * msq and may call msq. A callback must return: it must not end its thread (pthread_exit). Only
 * callbacks of objects defined with concurrent = 1 may run on other threads: those of msq, or those
 * of the host's parallel_for. If a thread cannot be started, the call uses the threads that exist.
 * Working memory is kept for the next call and freed with the last context of the process.
 *
 * Stack. A thread of the host with a stack of 64 KiB may call every function: large working memory
 * is on the heap, and thread-local storage takes less than 1 KiB. Three kinds of calls need more:
 * those that read binary STL (by Assimp), those that use CGAL (MSQ_FOAM_METHOD_2,
 * msq_shape_self_intersections) and those that read documents. Callbacks of the host use the same
 * stack.
 *
 * Process. msq never prints, exits, aborts, installs a signal handler, reads the environment, or
 * changes the locale. No C++ exception leaves it. (oneTBB, the thread library, prints its version
 * if the environment variable TBB_VERSION is set.)
 *
 * Floating point. Each call sets the floating-point environment on entry (round to nearest, no
 * traps, denormals kept) and restores the host's on return, flags included. Results never depend on
 * the host's environment. Callbacks run in the host's environment, also on threads of msq.
 *
 * Cost. A function whose comment states no cost takes constant time.
 *
 * Every declaration exists since version 0.2 unless its comment says otherwise.
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
#elif defined(__GNUC__) && !defined(_WIN32)
#define MSQ_API __attribute__((visibility("default")))
#else
#define MSQ_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Version, status, errors ----------------------------------------------------------------- */

#define MSQ_VERSION_MAJOR 0
#define MSQ_VERSION_MINOR 2
#define MSQ_VERSION_PATCH 0
/** Version of this header: major * 10000 + minor * 100 + patch. */
#define MSQ_VERSION 200

/** Result of a function: MSQ_OK or a negative MSQ_E_*. */
typedef int32_t msq_status;

/** Values of msq_status. */
enum msq_status_code {
  MSQ_OK = 0,
  /** An argument is NULL, not finite, out of range, or inconsistent with another. */
  MSQ_E_ARGUMENT = -1,
  /** An allocation failed. */
  MSQ_E_MEMORY = -2,
  /** The job was cancelled. */
  MSQ_E_CANCELLED = -3,
  /** A host callback failed, see msq_error_host_code(), or returned an invalid value (host code 0).
   */
  MSQ_E_HOST = -4,
  /** A file cannot be opened or read, is truncated, or is malformed. */
  MSQ_E_IO = -5,
  /** This build lacks the feature, or msq does not read the file format. */
  MSQ_E_UNSUPPORTED = -6,
  /** Malformed mesh arrays. Dirty meshes are not an error. */
  MSQ_E_MESH = -7,
  /** A documented limit would be exceeded, for example the memory limit of the context. */
  MSQ_E_LIMIT = -8,
  /** A defect in msq. Please report it. */
  MSQ_E_INTERNAL = -9
};

/** Returns the version of the loaded library, in the form of MSQ_VERSION. */
MSQ_API uint32_t msq_version(void);

/** Returns the name of a status, for example "MSQ_E_LIMIT"; "MSQ_E_UNKNOWN" for other values.
 * The string is static. */
MSQ_API const char* msq_status_name(msq_status status);

/** Returns the message of the last failure on the calling thread, one line in UTF-8; "" before the
 * first failure. The string is valid until the next failure on this thread. */
MSQ_API const char* msq_error_message(void);

/** Returns the code that a host callback returned at the last MSQ_E_HOST on the calling thread; 0
 * before the first one. */
MSQ_API int32_t msq_error_host_code(void);

/** How the loaded library was built. */
typedef struct msq_build_report {
  /** In: size of the caller's struct. */
  uint32_t struct_size;
  /** As msq_version(). */
  uint32_t version;
  /** 1 if all mesh formats are read. 0: no binary STL, 3MF and AMF. */
  int32_t with_assimp;
  /** 1 if MSQ_FOAM_METHOD_2 and msq_shape_self_intersections are available. */
  int32_t with_cgal;
  /** SPDX licence of this binary together with the libraries it is built on. Static. */
  const char* licence;
  /** Instruction set that the kernels use on this machine, for example "AVX3". Static. */
  const char* simd;
  /** 1 if msq_shape_hash and the other hash functions are available. */
  int32_t with_xxhash;
  /** 1 if documents are read and written (msq_document_from_json). */
  int32_t with_json;
  /** 1 if documents may name stacks of TIFF files. */
  int32_t with_tiff;
  uint32_t reserved;
} msq_build_report;

/** Reports how the loaded library was built. Errors: ARGUMENT. */
MSQ_API msq_status msq_build_info(msq_build_report* report);

/* ---- Context and job ------------------------------------------------------------------------- */

/** Threads, cell cache and memory limit that objects share. */
typedef struct msq_context msq_context;

/** Progress and cancellation of one long call. */
typedef struct msq_job msq_job;

/** Which cached cells are evicted first. Cells in use are never evicted. */
enum msq_cache_policy {
  /** The oldest cell first. Best for slicing from one end to the other. */
  MSQ_CACHE_FIFO = 0,
  /** Cells that were used only once first (S3-FIFO). Best if frames or sets use the same cells
   * again and not all of these cells fit. */
  MSQ_CACHE_SEGMENTED = 1
};

/** What a warning is about. */
enum msq_warning_code {
  /** A mesh is not closed. MSQ_WINDING_AUTO decides membership by its generalised winding number.
   * Once per shape, by the function that creates it. */
  MSQ_WARNING_OPEN_MESH = 1,
  /** The smallest cells of a structure are less than 4 pixels wide or 4 layers high. Once per
   * slicer, by msq_slicer_create. */
  MSQ_WARNING_COARSE_PITCH = 2,
  /** Cells were built for one use, because the cache had no room for them. Once per context, by
   * a set query, msq_slicer_run, msq_slice_layer, msq_printability, msq_ray_cast or msq_render. Not
   * given with cache_bytes = 0. */
  MSQ_WARNING_SMALL_CACHE = 3,
  /** Unit cells of a lattice have nodes on their faces that the next cell, or another one of the
   * library, does not have. Once per structure, by msq_structure_lattice. msq_unit_cell_info and
   * msq_lattice_faces locate them. */
  MSQ_WARNING_UNMATCHED_CELLS = 4
};

/** Receives a warning: something legal but doubtful. code: an msq_warning_code; later versions may
 * add some. message: in UTF-8, with the values, valid until the callback returns.
 *
 * It is called on the thread that called msq, after the function that warns has done its work and
 * before it returns. No lock is held, so the callback may call msq. A constructor has not written
 * its handle yet. Exceptions of the host's language must not leave it. */
typedef void (*msq_warning_fn)(void* user, int32_t code, const char* message);

/** Called once when an object is freed. */
typedef void (*msq_release_fn)(void* user);

/** One task of a loop of msq. It returns when its work is done and throws nothing. i: its number.
 */
typedef void (*msq_task_fn)(void* task, uint64_t i);

/** Shares the tasks of a loop among threads of the host: calls body(task, i) once for each i from 0
 * to count - 1 and returns when all these calls have returned. Pass task on unchanged.
 *
 * The calls may run on any threads, in any order, at once or one after the other on the calling
 * thread. Several threads may call this function at the same time, also from within a task. Such a
 * call must not wait for a thread to become free: where all are busy, the calling thread runs the
 * tasks itself.
 *
 * Return 0 for success. Any other code, preferably negative, stops the call of msq with MSQ_E_HOST;
 * tasks that have not begun may then be skipped. Exceptions of the host's language must not leave
 * the function. */
typedef int32_t (*msq_parallel_for_fn)(void* user, uint64_t count, msq_task_fn body, void* task);

/** Definition of a context. */
typedef struct msq_context_def {
  uint32_t struct_size;
  /** Threads per call, including the caller. 0 (default): one per core; larger values are clamped
   * to that, unless beyond_cores is 1. 1: the calling thread only. With parallel_for: tasks per
   * loop, clamped to 1024. */
  uint32_t threads;
  /** Maximum size of the cell cache in bytes. Default 1 GiB. 0: no cache. Does not change results.
   */
  uint64_t cache_bytes;
  /** Maximum number of bytes in use at one time for meshes, images, beams, slabs, cached cells,
   * fill lines and file reading (8 times the size of the file). Cached cells are evicted to make
   * room. 0 (default): no limit. Not counted: what a thread works on (about 5 MB per thread for
   * foams, 1 to 36 MB in all for two threads and layers of 16384^2 or sets of 1e9 points, less than
   * 1 MB for fill lines), working memory that is kept between calls (at most 16 MiB for most
   * kinds), and arrays of the host. docs/howto/memory.md has a table. */
  uint64_t memory_limit;
  /** An msq_cache_policy. Default MSQ_CACHE_FIFO. Does not change results. */
  int32_t cache_policy;
  /** 1: there may be more threads than cores, up to 1024. This is for tests. 0 (default): at most
   * one thread per core. Ignored with parallel_for. Does not change results. */
  uint32_t beyond_cores;
  /** Receives warnings about objects of this context. NULL (default): none. Must be valid as long
   * as the context. Models keep the context alive. */
  msq_warning_fn warning;
  /** Passed to warning. */
  void* warning_user;

  /* Threads of the host. */

  /** Runs the loops of msq on threads of the host. msq then starts no thread of its own. NULL
   * (default): threads of msq. Does not change results. */
  msq_parallel_for_fn parallel_for;
  /** First argument of parallel_for. */
  void* parallel_for_user;
  /** NULL, or called with parallel_for_user when the context is freed, on the thread that drops the
   * last reference. Models and other objects keep references to their context. It is not called if
   * msq_context_create fails. */
  msq_release_fn parallel_for_release;

  /* Lifetime of warning_user. */

  /** NULL, or called with warning_user when the context is freed, on the thread that drops the last
   * reference. Models and other objects keep references to their context. It is not called if
   * msq_context_create fails. */
  msq_release_fn warning_release;
} msq_context_def;

/** Sets the defaults. size: sizeof of the caller's struct. Errors: ARGUMENT. */
MSQ_API msq_status msq_context_def_init(msq_context_def* def, size_t size);

/** Creates a context. def NULL: defaults. Results never depend on the context. No thread is started
 * before the first call that needs one. Errors: ARGUMENT, MEMORY. Calls that use a context with
 * parallel_for: HOST. */
MSQ_API msq_status msq_context_create(const msq_context_def* def, msq_context** context);
/** Adds a reference. */
MSQ_API void msq_context_retain(msq_context* context);
/** Drops a reference. */
MSQ_API void msq_context_release(msq_context* context);

/** Memory that is accounted to a context. */
typedef struct msq_memory_report {
  uint32_t struct_size;
  uint32_t reserved;
  /** Bytes in use now by meshes, images, beams, slabs and cached cells. */
  uint64_t bytes;
  /** Maximum of bytes so far. */
  uint64_t peak_bytes;
  /** The limit of the definition. 0: no limit. */
  uint64_t limit_bytes;
} msq_memory_report;

/** Reports the memory accounted to the context. Errors: ARGUMENT. */
MSQ_API msq_status msq_context_memory(const msq_context* context, msq_memory_report* report);

/** Counters of the cell cache. */
typedef struct msq_cache_report {
  uint32_t struct_size;
  uint32_t reserved;
  /** Cell lookups that found the cell; lookups that did not find it; evicted cells. */
  uint64_t hits, misses, evictions;
  /** Bytes in use now by cells and reserved for cells under construction. Never above limit_bytes.
   */
  uint64_t bytes;
  uint64_t peak_bytes, limit_bytes;
  /** The part of bytes that is reserved for cells under construction. */
  uint64_t building_bytes;
  /** Number of cells in the cache now. */
  uint64_t cells;
  /** Misses for which two threads built the same cell at the same time. */
  uint64_t duplicates;
  /** Misses for which no room was found: the cell served one caller and was freed. */
  uint64_t unkept;
} msq_cache_report;

/** Reports the counters of the cell cache since the context was created.
 *
 * Before a cell is built, msq reserves the size that recent cells of the structure had. A cell that
 * turns out larger is counted in full from then on. Not counted: working memory of builders, unkept
 * cells, and cells in use that msq_cache_clear or the memory limit dropped.
 * Errors: ARGUMENT. Source: paper, section "Set Queries for Ray-Casting" (FIFO cache). */
MSQ_API msq_status msq_cache_stats(const msq_context* context, msq_cache_report* report);

/** Drops all cached cells. Running calls keep the cells that they use. The counters remain. The
 * cells of a structure are also dropped when its last reference goes. Errors: ARGUMENT. */
MSQ_API msq_status msq_cache_clear(msq_context* context);

/** Creates a job. Pass it to one long call at a time; two calls at once mix their progress.
 * Errors: ARGUMENT, MEMORY. */
MSQ_API msq_status msq_job_create(msq_job** job);
/** Adds a reference. */
MSQ_API void msq_job_retain(msq_job* job);
/** Drops a reference. */
MSQ_API void msq_job_release(msq_job* job);

/** Cancels the call that runs under the job. The call returns MSQ_E_CANCELLED, usually within tens
 * of milliseconds. The job stays cancelled: later calls under it return at once. Errors: ARGUMENT.
 */
MSQ_API msq_status msq_job_cancel(msq_job* job);

/** Returns the completed fraction, 0 to 1, of the last call under the job. It is 1 only after
 * success. Errors: ARGUMENT. */
MSQ_API msq_status msq_job_progress(const msq_job* job, double* fraction);

/** Which parts of the engine evaluated the points of a set query. */
typedef struct msq_job_report {
  uint32_t struct_size;
  uint32_t reserved;
  /** Points evaluated so far. */
  uint64_t points;
  /** Points decided by the coarse shape alone: they are outside it, or no finer scale is resolved.
   */
  uint64_t by_shape;
  /** Points that structures evaluated one at a time. A point counts once per structure. */
  uint64_t by_point;
  /** Points that structures evaluated in groups. A point counts once per structure. */
  uint64_t by_set;
  /** Number of these groups. On grids a group is a tile of rows. */
  uint64_t groups;
} msq_job_report;

/** Reports the counters of the last set query or statistic under the job; zeros for other calls.
 * Errors: ARGUMENT.
 * Source: paper, section "Structured and Unstructured Set Queries" (critical number of points). */
MSQ_API msq_status msq_job_info(const msq_job* job, msq_job_report* report);

/* ---- Windows --------------------------------------------------------------------------------- */

/** A part of a grid: the samples (i, j, k) with first <= (i, j, k) < first + count along each axis.
 * All zeros (default): the whole grid. Otherwise each count is at least 1.
 *
 * Positions depend on the index in the whole grid alone: origin + (i, j, k) * spacing. So windows
 * that tile a grid have, byte for byte, the results of the whole. A smaller grid with a shifted
 * origin does not: its positions are rounded differently. */
typedef struct msq_window {
  /** Index of the first sample in the whole grid. */
  uint64_t first[3];
  /** Number of samples along x, y and z. */
  uint64_t count[3];
} msq_window;

/* ---- Objects that the host defines ----------------------------------------------------------- */

/* A host may define its own fields, shapes and structures by callbacks: msq_field_host,
 * msq_shape_from_host, msq_structure_host, msq_structure_host_function. These rules apply to all of
 * their callbacks:
 *
 * Results depend on the arguments alone. A point has the same result, to the last bit, in every
 * batch.
 *
 * Threads. concurrent = 0 (default): callbacks run on the thread that called msq, one at a time,
 * and msq computes models with such an object on that thread alone. If several host threads call
 * msq, each receives its own callbacks. concurrent = 1: callbacks may run on any thread, several at
 * once. With parallel_for these are the threads that it calls its tasks on.
 *
 * Failure. A callback returns 0 for success. Any other code, preferably negative, stops the call
 * with MSQ_E_HOST. A value that is not a number, or outside the range that the definition promises,
 * stops it with MSQ_E_HOST and host code 0. The outputs of a set query that stops may be partly
 * written. Exceptions of the host's language must not leave a callback.
 *
 * Lifetime. Every callback receives the definition's user pointer. release, if not NULL, is called
 * once with it, when the object is freed and no other callback can follow, on the thread that
 * dropped the last reference. It is not called if the constructor fails. Callbacks may call msq,
 * but not on an object that they are part of.
 *
 * Points and boxes belong to msq and are valid until the callback returns. A batch has at most 4096
 * points, as triples x, y, z. docs/hosts.md shows the smallest example.
 *
 * Hashes. msq cannot see what callbacks compute. So the host chooses a hash_key of 128 bits, which
 * msq_shape_hash and the other hash functions use instead. The host must change the key whenever
 * results of the callbacks change, also from one run of the host to the next. Both words 0
 * (default): no key, and these functions return MSQ_E_UNSUPPORTED. Other results do not depend on
 * the key. */

/** Writes values[i], the value at point i, for i < count. */
typedef int32_t (*msq_values_fn)(void* user, const double* points, uint64_t count, double* values);

/** Writes bounds of all values in the box from min to max. The bounds include rounding. */
typedef int32_t (*msq_range_fn)(void* user, const double min[3], const double max[3], double* low,
                                double* high);

/* ---- Shapes: scale 0 ------------------------------------------------------------------------- */

/** A coarse solid. */
typedef struct msq_shape msq_shape;

/** Winding numbers that are inside a mesh. */
enum msq_winding {
  /** All except 0. Overlapping and inverted parts are solid. */
  MSQ_WINDING_NONZERO = 0,
  MSQ_WINDING_EVEN_ODD = 1,
  /** Only parts whose normals point outwards are solid. */
  MSQ_WINDING_POSITIVE = 2,
  /** Default. Closed meshes: NONZERO. Other meshes: NONZERO of the generalised winding number,
   * rounded half up to a whole number. */
  MSQ_WINDING_AUTO = 3
};

/** Type of the numbers in a host's array. Coordinates in model units are MSQ_FLOAT32 or
 * MSQ_FLOAT64. Images take all types except MSQ_INT32 and MSQ_INT64. Polygons to fill
 * (msq_fill_def) take MSQ_INT32 and MSQ_INT64. Contours take these two and MSQ_FLOAT64. */
enum msq_number_type {
  MSQ_FLOAT32 = 1,
  MSQ_FLOAT64 = 2,
  MSQ_UINT8 = 3,
  MSQ_INT16 = 4,
  MSQ_UINT16 = 5,
  MSQ_INT32 = 6,
  MSQ_INT64 = 7
};

/** Mesh file formats that msq reads. */
enum msq_format {
  /** By the extension of the file. */
  MSQ_FORMAT_AUTO = 0,
  /** Binary or ASCII. */
  MSQ_FORMAT_STL = 1,
  MSQ_FORMAT_OBJ = 2,
  MSQ_FORMAT_PLY = 3,
  MSQ_FORMAT_OFF = 4,
  MSQ_FORMAT_3MF = 5,
  MSQ_FORMAT_AMF = 6,
  /** glTF 2.0, text or binary (GLB). */
  MSQ_FORMAT_GLTF = 7
};

/** The grid of neighbourhood cells of a structure, or the frame of an image. Cell (i, j, k)
 * contains the points origin + rotation * ((i, j, k) + u) * cell_size with 0 <= u < 1 in each
 * component.
 * Source: paper, section "Multiscale Shape-Material Modeling API". */
typedef struct msq_neighbourhood {
  /** Default 0. */
  double origin[3];
  /** Along the axes of the grid, 1e-75 to 1e75. Default 1. */
  double cell_size[3];
  /** Row-major. Orthonormal within 1e-9 with determinant +1; msq takes the nearest rotation.
   * Default identity. */
  double rotation[9];
} msq_neighbourhood;

/** Moves a grid along with a part: *placed receives the grid transformed by a matrix as in
 * msq_shape_placed. Seeds and unit cells move with the cells. So a structure on the new grid is the
 * same structure at another place, if the host scales its radius or thickness by the same factor.
 * The host moves fields and beams itself. Without this call a structure stays fixed to the model's
 * frame. The matrix may rotate, translate and scale uniformly. Errors: ARGUMENT (also a matrix that
 * mirrors, shears or stretches by more than 1e-9). */
MSQ_API msq_status msq_neighbourhood_placed(const msq_neighbourhood* grid, const double matrix[12],
                                            msq_neighbourhood* placed);

/** A graded period: cells whose size varies along one axis of a structure's grid. For example, it
 * varies the spacing of walls that are printed with lines of constant width.
 *
 * The number of cells per unit length, 1 / size, is linear between positions and constant before
 * the first and beyond the last. So the map from the coordinate to the number of cells from the
 * grid's origin is monotone and has a continuous slope: surfaces have no kinks, and cells do not
 * fold. grid.cell_size along this axis is ignored. The grid's origin is a corner of cells. The
 * largest cell size is the structure's characteristic length. docs/concepts.md defines the map bit
 * for bit. The arrays are copied. */
typedef struct msq_period_def {
  uint32_t struct_size;
  /** Axis of the grid, 0 to 2. Default 2. */
  int32_t axis;
  /** count coordinates along that axis, in model units from the grid's origin, ascending. Two
   * neighbours are at least 1e-6 times the smaller of their two cell sizes apart. No default. */
  const double* positions;
  /** Size of the cells at each position, in model units, 1e-75 to 1e75. The largest is at most 1024
   * times the smallest. No default. */
  const double* cell_sizes;
  /** 1 to 4096. */
  uint64_t count;
} msq_period_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_period_def_init(msq_period_def* def, size_t size);

/** A number at every point of space, with a known range. */
typedef struct msq_field msq_field;

/** Maps from space to warped cells. */
enum msq_warp_kind {
  /** Cells around the z axis of the grid. */
  MSQ_WARP_CYLINDRICAL = 1,
  /** Cells around the origin of the grid. */
  MSQ_WARP_SPHERICAL = 2,
  /** Cells placed by a map that the host samples. */
  MSQ_WARP_SAMPLED = 3
};

/** Warped cells: cells around an axis, around a point, or placed by a map that the host samples.
 * They take the place of boxes.
 *
 * CYLINDRICAL: the cells lie around the z axis of the structure's grid. SPHERICAL: they lie around
 * the origin of the grid, the centre, and the z axis points to the north pole. Cells have three
 * coordinates, each counted in cells:
 * - x goes outwards: (r - inner_radius) / cell_size[0], with r the distance from the axis or the
 *   centre.
 * - y goes around the z axis, from the x axis towards the y axis. A whole turn has count cells, so
 *   the pattern closes. cell_size[1] is not used.
 * - z of CYLINDRICAL goes along the axis: z / cell_size[2]. z of SPHERICAL goes from the south pole
 *   to the north pole, with count_polar cells between them; cell_size[2] is not used.
 * CYLINDRICAL cells may be sheared: msq adds shear_outwards times x and shear_along times z to y,
 * and removes whole turns. The pattern closes around the axis for any shear. A positive shear turns
 * the pattern from the y axis towards the x axis. Without a shear, the edges of cells on the
 * positive x axis of the grid are parallel to the axes of the grid.
 *
 * Cells become wider with their distance from the axis. At the axis and at the poles their width is
 * 0, so features there are arbitrarily small. The narrowest cells away from the poles are 2 pi
 * inner_radius / count wide: choose inner_radius so that a printer can print cells of this width.
 * Choose the shape so that it leaves out the poles.
 *
 * Cells fill the space from inner_radius to outer_radius. A functional structure is empty outside
 * of this space, and so is a foam. A lattice has the whole cells that fit in it
 * (msq_lattice_def.warp).
 *
 * SAMPLED: u, v and w are fields of samples (msq_field_grid) on one grid of at least 2 samples
 * along each axis. msq interpolates the samples. The three values at a point are its coordinates,
 * counted in cells, at most 2^22 in magnitude. Cells begin and end at whole numbers. The
 * structure's grid is not used. The cells fill the box of the samples. A functional structure is
 * empty outside of this box, and so is a foam. A lattice has the struts whose two nodes are in the
 * box. So sample one cell more than the part needs.
 *
 * The map must not fold: the determinant of its derivatives has one sign in all voxels, is nowhere
 * 0, and its magnitude is above 2^-40 times the product of the gradients' lengths. An angle that
 * jumps by a whole turn is a fold. For a whole ring use CYLINDRICAL; a part of a ring may be
 * sampled. If two points have the same coordinates, msq places the nodes of lattices and the
 * seeds of foams at one of them. Cost: SAMPLED makes two passes over the samples, about 0.1 us per
 * voxel. For lattices msq places all nodes in the box, about 1 us each; for foams all seeds, about
 * 2 us each. Usually a place costs about 200 looks at voxels. A map in which all places together
 * cost more than 1024 for each place, and more than 2^27, is refused (LIMIT): it has nearly the
 * same coordinates too often.
 *
 * docs/concepts.md defines the map bit for bit. */
typedef struct msq_warp_def {
  uint32_t struct_size;
  /** An msq_warp_kind. Default MSQ_WARP_CYLINDRICAL. */
  int32_t kind;
  /** CYLINDRICAL, SPHERICAL: cells around the z axis, 1 to 65536; no default. SAMPLED: 0. */
  uint32_t count;
  /** SPHERICAL: cells from pole to pole, 1 to 65536; no default. Other kinds: 0. */
  uint32_t count_polar;
  /** In model units, 0 to 1e75, and less than 2^24 cells. Default 0. SAMPLED: 0. */
  double inner_radius;
  /** In model units, above inner_radius, at most 1e75. 0 (default): no limit. SAMPLED: 0. */
  double outer_radius;
  /** SAMPLED: the coordinate x at each point, counted in cells. It is a field of msq_field_grid;
   * those of v and w have the same grid. No default. Other kinds: NULL. */
  const msq_field* u;
  /** SAMPLED: the coordinate y, as u. */
  const msq_field* v;
  /** SAMPLED: the coordinate z, as u. */
  const msq_field* w;
  /** CYLINDRICAL: number of cells by which the pattern turns around the axis per cell outwards, at
   * most 65536 in magnitude. Default 0. Other kinds: 0. */
  double shear_outwards;
  /** CYLINDRICAL: the same per cell along the axis, as in a twisted rope. The pattern makes a whole
   * turn in count / shear_along cells. Default 0. Other kinds: 0. */
  double shear_along;
} msq_warp_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_warp_def_init(msq_warp_def* def, size_t size);

/** Numbers on a regular grid, interpolated trilinearly. The values are copied, and msq keeps about
 * 1/7 byte per value in addition. */
typedef struct msq_image {
  /** size[2] layers of size[1] rows of size[0] values. */
  const void* values;
  /** MSQ_UINT8, INT16, UINT16, FLOAT32 or FLOAT64. No default. Floating-point values: at most 1e100
   * in magnitude. */
  int32_t value_type;
  /** Must be 0. */
  uint32_t reserved;
  /** Number of values along x, y and z: 1 to 2^20 each. */
  uint64_t size[3];
  /** Bytes from one row to the next. 0 (default): tightly packed. */
  uint64_t row_stride;
  /** Bytes from one layer to the next. 0 (default): size[1] rows. */
  uint64_t layer_stride;
  /** Value (i, j, k) is at origin + rotation * ((i, j, k) * cell_size): cell_size is the spacing of
   * the values. */
  msq_neighbourhood grid;
} msq_image;

/** How a mesh file is read. */
typedef struct msq_file_def {
  uint32_t struct_size;
  /** An msq_format. Default MSQ_FORMAT_AUTO, which needs a path. */
  int32_t format;
  /** An msq_winding. Default MSQ_WINDING_AUTO. */
  int32_t winding_rule;
  /** Must be 0. */
  uint32_t reserved;
  /** Length of the file's unit in mm for STL, OBJ, PLY and OFF, which name no unit. Default 1. The
   * units of 3MF and AMF files are read and applied; that of glTF is the metre. */
  double unit_mm;
  /** Maximum size in bytes of the file, and of what an archive unpacks to. 0 and default: 4 GiB. */
  uint64_t max_bytes;
  /** Maximum number of triangles. 0 and default: 200 million. */
  uint64_t max_triangles;
} msq_file_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_file_def_init(msq_file_def* def, size_t size);

/** Reads a triangle mesh from a file. def NULL: defaults. job NULL: no job. On Windows `path` is
 * UTF-8; other systems receive its bytes unchanged.
 *
 * All instances in the file become one shape in millimetres. msq applies transforms, triangulates
 * polygons, welds equal vertices, and drops triangles with fewer than three distinct vertices. It
 * opens no other file. Text is ASCII or UTF-8. A number in text becomes the nearest double. OBJ:
 * vertices and faces are read. glTF: the triangles of the default scene are read from buffers in
 * the file, and the transforms of nodes are applied; y, which is up in glTF, becomes z. Cost:
 * linear in the size of the file (a million triangles: about a second). Cancelling ends the call
 * within tens of milliseconds, except while the XML of 3MF or AMF is parsed. Errors: ARGUMENT, IO
 * (missing, truncated or malformed file; for OBJ and ASCII STL the message names the line),
 * UNSUPPORTED (format; text in UTF-16; binary STL, 3MF or AMF in a build without Assimp, glTF in
 * one without JSON; a 3MF file with beam lattices, see msq_beam_file_open; glTF with buffers in
 * other files, compressed or sparse data, or skins), MESH (no triangles, index out of range,
 * coordinate that is not finite or above 1e100 in millimetres), LIMIT, MEMORY, CANCELLED. */
MSQ_API msq_status msq_shape_from_file(msq_context* context, const char* path,
                                       const msq_file_def* def, msq_shape** shape, msq_job* job);

/** Reads a triangle mesh from bytes in memory. def must name the format and must not be NULL. See
 * msq_shape_from_file. */
MSQ_API msq_status msq_shape_from_memory(msq_context* context, const void* data, uint64_t bytes,
                                         const msq_file_def* def, msq_shape** shape, msq_job* job);

/** A triangle mesh in arrays. */
typedef struct msq_mesh_def {
  uint32_t struct_size;
  /** MSQ_FLOAT32 or MSQ_FLOAT64 (default). */
  int32_t coordinate_type;
  /** An msq_winding. Default MSQ_WINDING_AUTO. */
  int32_t winding_rule;
  /** Must be 0. */
  uint32_t reserved;
  /** vertex_count triples x, y, z. No alignment is needed. */
  const void* vertices;
  uint64_t vertex_count;
  /** Bytes from one vertex to the next. 0 (default): tightly packed. */
  uint64_t vertex_stride;
  /** triangle_count triples of vertex indices, counter-clockwise seen from outside. */
  const uint32_t* triangles;
  uint64_t triangle_count;
} msq_mesh_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_mesh_def_init(msq_mesh_def* def, size_t size);

/** Creates a shape from a triangle mesh. Dirty meshes (open, self-intersecting, flipped or
 * duplicate triangles) are accepted; msq_shape_info diagnoses them.
 *
 * Membership. A point in the bounding box of the mesh is inside if the winding number of the ray
 * from it along +x satisfies the winding rule. Crossings are half-open in y and z, so shared edges
 * and vertices count once. They are closed in x: a point on a crossing is inside if either side is.
 * Points exactly on a face that is highest in y or z are therefore outside; points on the opposite
 * face are inside. On faces that are not normal to an axis the position of the crossing is rounded,
 * by about 1e-16 of the coordinates.
 *
 * With MSQ_WINDING_AUTO a mesh that is not closed (msq_shape_report.closed is 0) uses the
 * generalised winding number, rounded half up to a whole number. The solid ends at the bounding
 * box. Distances are lower bounds. A skin follows the triangles, not the holes. Additional cost:
 * about 500 bytes per open edge. A point near a hole, or where the winding number is near a half,
 * may take a sum over all open edges.
 *
 * Limit: 2^32 - 1 vertices and triangles. Cost: linear in the number of triangles; msq keeps about
 * 75 bytes per triangle and needs 100 during construction. Errors: ARGUMENT, MESH (no triangles,
 * index out of range, coordinate that is not finite or above 1e100), LIMIT, MEMORY. Source:
 * Jacobson, Kavan and Sorkine-Hornung, "Robust inside-outside segmentation using generalized
 * winding numbers", 2013. */
MSQ_API msq_status msq_shape_from_mesh(msq_context* context, const msq_mesh_def* def,
                                       msq_shape** shape);

/** Creates an axis-aligned box with its boundary. Coordinates of min, and sides: up to 1e75.
 * Errors: ARGUMENT unless min < max along each axis; MEMORY. */
MSQ_API msq_status msq_shape_from_box(msq_context* context, const double min[3],
                                      const double max[3], msq_shape** shape);

/** Creates a ball with its boundary. Coordinates and radius: up to 1e75. Errors: ARGUMENT unless
 * radius > 0; MEMORY. */
MSQ_API msq_status msq_shape_from_sphere(msq_context* context, const double center[3],
                                         double radius, msq_shape** shape);

/** Creates a round cylinder with flat ends and its boundary. Coordinates, their differences and the
 * radius: up to 1e75. Errors: ARGUMENT unless from and to differ and radius > 0; MEMORY. */
MSQ_API msq_status msq_shape_from_cylinder(msq_context* context, const double from[3],
                                           const double to[3], double radius, msq_shape** shape);

/** Creates the shape that contains every point, for structures that the host clips itself. Its
 * bounds and its volume are infinite. It has no surface, so no scale can leave a skin in it, and
 * msq_field_shape_distance refuses it.
 *
 * A model of all space is queried like any other, with these differences. The limits of 2^24 cells
 * from the origin of a structure's grid and of 1e75 for coordinates apply to the points of each
 * query. A query beyond them fails with LIMIT and writes nothing. A slicer needs a region, and
 * contours need a window. Rays need a finite t_max. Pictures need a finite clip_far, no shadows,
 * and an occlusion_distance if they have occlusion rays; no camera fits the model. Where no
 * structure is resolved, distances are -1.8e308. Errors: ARGUMENT, MEMORY. */
MSQ_API msq_status msq_shape_all_space(msq_context* context, msq_shape** shape);

/** Writes inside[i]: 0 if point i is outside, any other value if it is inside or on the boundary.
 */
typedef int32_t (*msq_inside_fn)(void* user, const double* points, uint64_t count, uint8_t* inside);

/** A shape that the host computes. */
typedef struct msq_host_shape_def {
  uint32_t struct_size;
  /** 0 (default) or 1. See "Objects that the host defines". */
  int32_t concurrent;
  /** Membership of points in the bounding box, in model coordinates. */
  msq_inside_fn inside;
  /** Lower bound on the distance to the boundary, for any points, on either side; its sign is
   * ignored. It must have Lipschitz constant 1. NULL (default): the distance to the bounding box, 0
   * inside it. */
  msq_values_fn distance;
  void* user;
  msq_release_fn release;
  /** Bounding box, with the limits of msq_shape_from_box. No default. */
  double min[3], max[3];
  /** Represents the callbacks in hashes. Both 0 (default): no key. */
  uint64_t hash_key[2];
} msq_host_shape_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_host_shape_def_init(msq_host_shape_def* def, size_t size);

/** Creates a shape from callbacks. It has no depth, so no scale can leave a skin in it. Slices and
 * arrays call back with batches of points, distances with single points. def must not be NULL.
 * Errors: ARGUMENT unless min < max along each axis; MEMORY. Calls that use the shape: HOST. */
MSQ_API msq_status msq_shape_from_host(msq_context* context, const msq_host_shape_def* def,
                                       msq_shape** shape);

/** Which side of an image's threshold is solid. The threshold itself is solid. */
enum msq_solid_side { MSQ_SOLID_ABOVE = 0, MSQ_SOLID_BELOW = 1 };

/** A shape from a voxel image. */
typedef struct msq_voxels_def {
  uint32_t struct_size;
  /** An msq_solid_side. Default MSQ_SOLID_ABOVE. */
  int32_t solid;
  /** At least 2 values along each axis. */
  msq_image image;
  /** In the unit of the values. Default 0. */
  double threshold;
} msq_voxels_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_voxels_def_init(msq_voxels_def* def, size_t size);

/** Creates a shape from a voxel image, for example a CT scan: the points where the trilinear
 * function is on the solid side of the threshold, inside the box that the outermost values span.
 * def must not be NULL. It has no depth, so no scale can leave a skin in it. Limits: coordinates of
 * the origin, and the sum of the extents along the axes, up to 1e75. Cost: linear in the number of
 * values, on the calling thread (one or two seconds for 10^8). Rows and layers then visit the cells
 * that the surface crosses. Errors: ARGUMENT (also if no value is solid), LIMIT (memory limit of
 * the context), MEMORY. */
MSQ_API msq_status msq_shape_from_voxels(msq_context* context, const msq_voxels_def* def,
                                         msq_shape** shape);

/** Creates a shape from another one by an affine map, for example an instance of a part on a plate.
 * The two share mesh, image and trees. matrix: three rows of four numbers, row-major; a point q of
 * the original is placed at matrix * (q, 1). Rotations, scalings, mirror images and shears are
 * allowed.
 *
 * A point p is inside if the original contains B * (p - b). b is the last column. B is the inverse
 * of the first three columns, A, computed once in double precision. Skeel's condition is the
 * greatest row sum of |A| |B|. Scaling along an axis does not change it; shears and oblique axes
 * do. Lengths keep the unit of the model. If the map scales all directions alike (within 1e-6),
 * distance and depth are those of the original, scaled. Otherwise the distance is at least the
 * original's times the smallest scale of a direction, and the shape has no depth, so no scale can
 * leave a skin in it: transform the vertices of a mesh instead. Bounds enclose the placed bounding
 * box of the original.
 *
 * Cost: constant. Points and rays cost what they cost in the original. Layers of a closed mesh cost
 * up to twice those of the original; the first one places a copy of its vertices and triangles,
 * which counts against the memory limit. Layers of other shapes evaluate the distance at a few
 * samples per sample of the outline, which costs tens of times as much as an unplaced mesh. Errors:
 * ARGUMENT (numbers that are not finite; a singular matrix, or one with Skeel's condition above
 * 1e6; lengths that grow or shrink by more than 1e75; coordinates above 1e75), LIMIT (more than 64
 * shapes made of shapes within each other), UNSUPPORTED (all space), MEMORY. */
MSQ_API msq_status msq_shape_placed(const msq_shape* original, const double matrix[12],
                                    msq_shape** shape);

/** Boolean operations on shapes and on structures. */
enum msq_boolean_operation {
  /** Points in any of them. */
  MSQ_BOOLEAN_UNION = 1,
  /** Points in all of them. */
  MSQ_BOOLEAN_INTERSECTION = 2,
  /** Points of the first that are in no other. The boundary of what is subtracted is outside. */
  MSQ_BOOLEAN_DIFFERENCE = 3
};

/** Creates the union, intersection or difference of shapes (operation: an msq_boolean_operation)
 * from their memberships. shapes: count shapes, 1 to 4096.
 *
 * Distance of a union: the smallest of the shapes' signed distances, exact outside if theirs are, a
 * bound inside. Of an intersection: the largest, exact inside, a bound outside. Of a difference:
 * that of the intersection with complements. Two kinds have depth, so scales can leave a skin in
 * them: intersections and differences of shapes with depth and exact distances, and unions of
 * shapes with depth whose bounding boxes do not meet. Volume and area are NaN. Cost: the sum of the
 * shapes'. Errors: ARGUMENT (also an intersection of shapes whose bounding boxes do not meet),
 * LIMIT (as msq_shape_placed; more than 4096 shapes in all, counted with repetition), UNSUPPORTED
 * (all space), MEMORY. */
MSQ_API msq_status msq_shape_boolean(int32_t operation, const msq_shape* const* shapes,
                                     uint64_t count, msq_shape** shape);

/** Creates a shape from another one by moving its surface by a distance, outwards if it is positive
 * and inwards if it is negative: the points whose signed distance to the original
 * (msq_point_distance) is at most distance. Outwards, edges become round.
 *
 * The original's distance must be exact on the side to which the surface moves. It is exact for
 * primitives and closed meshes, also if placed with a uniform scale; outwards for unions of these;
 * inwards for intersections and differences of these; and for offsets that are moved again to the
 * same side. Triangles of a mesh that bound nothing count as its surface. The distance of the new
 * shape is exact beyond its surface on that side, a bound on the other. Shapes that are moved
 * inwards have depth if the original has. Cost: a mesh builds its tree at once; then a distance of
 * the original per point. Errors: ARGUMENT (distance 0 or not finite, an offset inwards by more
 * than half the bounding box, coordinates above 1e75), UNSUPPORTED (the distance of the original is
 * a bound on that side; all space), LIMIT (as msq_shape_placed; memory), MEMORY. */
MSQ_API msq_status msq_shape_offset(const msq_shape* original, double distance, msq_shape** shape);

/** Adds a reference. */
MSQ_API void msq_shape_retain(msq_shape* shape);
/** Drops a reference. */
MSQ_API void msq_shape_release(msq_shape* shape);

/** Bounds, size and diagnosis of a shape. */
typedef struct msq_shape_report {
  uint32_t struct_size;
  /** 1 for a mesh, also a placed one. 0 for other shapes; their counts below are 0. */
  int32_t is_mesh;
  /** Bounding box. */
  double min[3];
  double max[3];
  /** Cubic model units. Meshes: signed sum over the triangles, exact for closed meshes up to
   * rounding, negative if inside out. Open meshes with MSQ_WINDING_AUTO: that of the mesh with
   * capped holes, without pieces whose caps exceed 3/4 of their area. Voxels: sum of the boxes of
   * the solid values, as far as they are in the image's box. Host shapes, booleans and offsets:
   * NaN. */
  double volume;
  /** Square model units. NaN for shapes without a formula: voxels, host shapes, booleans, offsets,
   * stretched shapes. Meshes: infinite or 0 if sides of triangles are above 1e75 or below 1e-75. */
  double area;
  /** Vertices after welding. */
  uint64_t vertices;
  /** Triangles that were kept. */
  uint64_t triangles;
  /** Triangles without area. Those with fewer than three distinct vertices are dropped. Collinear
   * ones are kept, because they close the surface. */
  uint64_t degenerate_triangles;
  /** Kept triangles with the same three vertices as an earlier one. */
  uint64_t duplicate_triangles;
  /** Edges with one triangle. */
  uint64_t open_edges;
  /** Edges with three or more triangles. */
  uint64_t non_manifold_edges;
  /** Edges with two triangles that run along the edge in the same direction. */
  uint64_t flipped_edges;
  /** 1 if along every edge as many triangles run one way as the other. */
  int32_t closed;
  int32_t reserved;
} msq_shape_report;

/** Reports bounds, volume, area and the diagnosis of a dirty mesh, as found at construction.
 * Errors: ARGUMENT. */
MSQ_API msq_status msq_shape_info(const msq_shape* shape, msq_shape_report* report);

/** Hashes a shape. The 16 bytes are equal for equal definitions with equal inputs and differ
 * otherwise. With them a host knows whether results that it computed from the shape are still
 * valid.
 *
 * They are the same in each run, on each machine, with any number of threads and in all builds of
 * one version of msq. Another version may change them. They do not depend on file names, the
 * context and options whose comment says "Does not change results". They depend on all other fields
 * of a definition. For a mesh these are its vertices and triangles after welding, in their order;
 * for an image its values and their type; for an expression its operations, without spaces and
 * names. 0 and -0 are equal numbers. Shapes, fields, structures and materials within an object
 * contribute their hashes. docs/howto/caching.md has the details.
 *
 * It is a checksum (XXH3, 128 bits), not a signature: an attacker can make two different objects
 * with the same hash. Cost: the first call reads all inputs once, at some gigabytes per
 * second; the object keeps the result. Errors: ARGUMENT, UNSUPPORTED (an object of the host without
 * a hash_key in it; a build without xxHash), MEMORY. */
MSQ_API msq_status msq_shape_hash(const msq_shape* shape, uint8_t hash[16]);

/** Counts the pairs of triangles in which a mesh intersects itself. Other shapes: 0.
 *
 * A pair counts if its triangles cross, touch, overlap in a plane or are duplicates; a shared
 * vertex or edge alone does not count (CGAL::Polygon_mesh_processing::self_intersections). The
 * decision is exact, after welding, without triangles that have no area. This is a diagnosis: no
 * result of a shape depends on it.
 *
 * job NULL: no job; progress jumps from 0 to 1 at the end. Cost: about n log^3 n for n triangles
 * plus a test per pair of overlapping boxes, on the calling thread (about a second for 270,000
 * triangles), with about 100 bytes per triangle. Errors: ARGUMENT, CANCELLED, UNSUPPORTED (a mesh,
 * in a build without CGAL), MEMORY. Source: Zomorodian and Edelsbrunner, "Fast software for box
 * intersections", 2002. */
MSQ_API msq_status msq_shape_self_intersections(const msq_shape* shape, uint64_t* pairs,
                                                msq_job* job);

/* ---- Fields ---------------------------------------------------------------------------------- */

/** Creates a linear gradient: from_value in the plane through from, to_value in the plane through
 * to, both normal to to - from; linear between the planes and constant beyond them. Errors:
 * ARGUMENT unless from and to are 1e-140 to 1.3e154 apart and the difference of the values is
 * finite; MEMORY. */
MSQ_API msq_status msq_field_gradient(msq_context* context, const double from[3], double from_value,
                                      const double to[3], double to_value, msq_field** field);

/** A field by the distance from a point or a line. */
typedef struct msq_radial_field_def {
  uint32_t struct_size;
  uint32_t reserved;
  /** Default 0. */
  double center[3];
  /** Direction of the line through center, of any length. 0 (default): distance from the point
   * center. */
  double axis[3];
  /** At least 0. Default 0. */
  double from_radius;
  double from_value;
  /** Greater than from_radius. Default 1. */
  double to_radius;
  double to_value;
} msq_radial_field_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_radial_field_def_init(msq_radial_field_def* def, size_t size);

/** Creates a field that is from_value up to from_radius, to_value from to_radius on, and linear
 * between. def must not be NULL. Errors: ARGUMENT (also if the difference of the values is not
 * finite), MEMORY. */
MSQ_API msq_status msq_field_radial(msq_context* context, const msq_radial_field_def* def,
                                    msq_field** field);

/** Creates a piecewise linear curve over another field.
 *
 * curve: curve_count pairs (value of argument, value of this field), 1 to 65536, strictly ascending
 * in the first component. The curve is constant beyond its ends. Differences of neighbours must be
 * finite. Cost per point: that of argument plus log(curve_count). Errors: ARGUMENT, LIMIT (more
 * than 64 nested maps), MEMORY. */
MSQ_API msq_status msq_field_map(msq_context* context, const msq_field* argument,
                                 const double* curve, uint64_t curve_count, msq_field** field);

/** A field that the host computes. */
typedef struct msq_host_field_def {
  uint32_t struct_size;
  /** 0 (default) or 1. See "Objects that the host defines". */
  int32_t concurrent;
  /** Values at points of space, anywhere, in model coordinates. */
  msq_values_fn evaluate;
  /** Bounds over a box in model coordinates. NULL (default): derived from lipschitz. */
  msq_range_fn range;
  void* user;
  msq_release_fn release;
  /** Bounds of all values. Finite. No default. */
  double low, high;
  /** Lipschitz constant of the values. Infinity (default): unknown. */
  double lipschitz;
  /** Represents the callbacks in hashes. Both 0 (default): no key. */
  uint64_t hash_key[2];
} msq_host_field_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_host_field_def_init(msq_host_field_def* def, size_t size);

/** Creates a field from callbacks. def must not be NULL.
 *
 * msq decides whole blocks of points by the range over a box. Without range and lipschitz the range
 * is low to high everywhere: correct, but slow. If range or lipschitz are too narrow, results are
 * wrong, but behaviour stays defined. Cost: points and struts call back with one point; sets, and
 * slices of functional structures, of foams and of turned lattices, with batches.
 * Errors: ARGUMENT, MEMORY. Calls that use the field: HOST. */
MSQ_API msq_status msq_field_host(msq_context* context, const msq_host_field_def* def,
                                  msq_field** field);

/** A field from an image. */
typedef struct msq_grid_field_def {
  uint32_t struct_size;
  /** Must be 0. */
  uint32_t reserved;
  msq_image image;
} msq_grid_field_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_grid_field_def_init(msq_grid_field_def* def, size_t size);

/** Creates a field from an image: trilinear between the values; outside the image it has the value
 * of the nearest point of its border. Its Lipschitz constant is that of the steepest pair of
 * neighbours. def must not be NULL. Cost: linear in the number of values, on the calling thread (a
 * second for 10^8); nanoseconds per point. Errors: ARGUMENT, LIMIT (memory limit of the context),
 * MEMORY. */
MSQ_API msq_status msq_field_grid(msq_context* context, const msq_grid_field_def* def,
                                  msq_field** field);

/** A named number in an expression. */
typedef struct msq_named_value {
  /** Letters a to z and A to Z, digits and _; does not begin with a digit; not a name that
   * expressions define; no name twice. */
  const char* name;
  double value;
} msq_named_value;

/** A field from an expression. */
typedef struct msq_expression_field_def {
  uint32_t struct_size;
  /** Must be 0. */
  uint32_t reserved;
  /** Text in the grammar of msq_structure_functional. */
  const char* expression;
  /** parameter_count names that the text may use. */
  const msq_named_value* parameters;
  /** At most 1024. */
  uint64_t parameter_count;
  /** The value is clamped to this range. Finite, low <= high. Default 0. */
  double low, high;
} msq_expression_field_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_expression_field_def_init(msq_expression_field_def* def, size_t size);

/** Creates a field from an expression in x, y and z, clamped to low and high; low where the value
 * is not a number. x, y and z are model coordinates, not angles. def must not be NULL. Rays use a
 * bound of the slope over each box where the expression is smooth. The field has no global
 * Lipschitz constant. Distances to surfaces that depend on it use the slope in boxes around the
 * point, and are 0 where no such slope is known (docs/accuracy.md). Errors: ARGUMENT,
 * LIMIT (as msq_structure_functional), MEMORY. */
MSQ_API msq_status msq_field_expression(msq_context* context, const msq_expression_field_def* def,
                                        msq_field** field);

/** A field by the signed distance to a shape. */
typedef struct msq_shape_distance_field_def {
  uint32_t struct_size;
  /** Must be 0. */
  uint32_t reserved;
  const msq_shape* shape;
  /** curve_count pairs (signed distance, value), strictly ascending in the first component, as in
   * msq_field_map. Distances inside are negative. */
  const double* curve;
  uint64_t curve_count;
  /** 0 (default): exact distance at every point. > 0: spacing of samples that are interpolated
   * trilinearly. */
  double step;
} msq_shape_distance_field_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_shape_distance_field_def_init(msq_shape_distance_field_def* def,
                                                     size_t size);

/** Creates a piecewise linear curve over the signed distance to a shape, as msq_point_distance
 * returns it. def must not be NULL. job NULL: no job.
 *
 * With a step, msq samples the distance once over the bounding box of the shape and a step around
 * it, on the threads of the context, in single precision. Outside, the field has the value of the
 * nearest point of the border. The error inside is below step * sqrt(3), and far smaller away from
 * edges and medial surfaces. Cost: without a step, that of msq_point_distance per point and strut
 * (microseconds), and the tree of a mesh's triangles, which this call builds; with a step, that of
 * msq_field_grid with 4-byte values. Errors: ARGUMENT (also more than 2^20 steps along an axis, a
 * step below 1.2e-38, and distances that exceed a float), LIMIT (memory limit of the context),
 * UNSUPPORTED (all space), HOST, CANCELLED, MEMORY. */
MSQ_API msq_status msq_field_shape_distance(msq_context* context,
                                            const msq_shape_distance_field_def* def,
                                            msq_field** field, msq_job* job);

/** Hashes a field, as msq_shape_hash does. A field by the distance to a shape that was sampled with
 * a step is hashed from its samples. Errors: as msq_shape_hash. */
MSQ_API msq_status msq_field_hash(const msq_field* field, uint8_t hash[16]);
/** Adds a reference. */
MSQ_API void msq_field_retain(msq_field* field);
/** Drops a reference. */
MSQ_API void msq_field_release(msq_field* field);

/** A parameter: the field, or value if field is NULL. Objects retain the fields of their
 * parameters. */
typedef struct msq_param {
  double value;
  const msq_field* field;
} msq_param;

/* ---- Structures: scales 1 and finer ---------------------------------------------------------- */

/** A fine-scale structure: a solid in all space. */
typedef struct msq_structure msq_structure;

/** Unit cells of strut lattices. Nodes and struts are in the unit cube; the number of struts is
 * that of one cell. */
enum msq_unit_cell {
  /** Nodes and struts of the definition. */
  MSQ_UNIT_CELL_CUSTOM = 0,
  /** Edges of the cube: 3 struts. */
  MSQ_UNIT_CELL_CUBIC = 1,
  /** Centre to the 8 corners. */
  MSQ_UNIT_CELL_BCC = 2,
  /** Corners to face centres, and the octahedron of the face centres: 24 struts. */
  MSQ_UNIT_CELL_OCTET = 3,
  /** Diagonals of the faces: 12 struts. */
  MSQ_UNIT_CELL_FCC = 4,
  /** Edges of space-filling truncated octahedra: 24 struts. */
  MSQ_UNIT_CELL_KELVIN = 5,
  /** Bonds of the diamond crystal: 16 struts. */
  MSQ_UNIT_CELL_DIAMOND = 6,
  /** Edges of space-filling rhombic dodecahedra: 32 struts. */
  MSQ_UNIT_CELL_RHOMBIC_DODECAHEDRON = 7,
  /** Auxetic: widens in x and y when pulled along z. Uprights along z, 3/4 of the cell high, every
   * second one half a cell higher, and slanted struts between the ends of neighbours: 22 struts. */
  MSQ_UNIT_CELL_REENTRANT = 8
};

/** A unit cell: a named one, or nodes and struts. */
typedef struct msq_unit_cell_def {
  uint32_t struct_size;
  /** An msq_unit_cell. Default MSQ_UNIT_CELL_BCC. */
  int32_t unit_cell;
  /** CUSTOM: node_count triples, in [0, 1]. */
  const double* nodes;
  /** 1 to 4096. */
  uint64_t node_count;
  /** CUSTOM: strut_count pairs of indices of different nodes. */
  const uint32_t* struts;
  /** 1 to 4096. A named cell needs it only with strut_factors. */
  uint64_t strut_count;
  /** Factor of the radius for each strut, 0.001 to 1000. NULL (default): all 1. */
  const double* strut_factors;
} msq_unit_cell_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_unit_cell_def_init(msq_unit_cell_def* def, size_t size);

/** Counts of a unit cell and the nodes that do not match their neighbours. */
typedef struct msq_unit_cell_report {
  uint32_t struct_size;
  /** 1 if unmatched_count is 0. */
  int32_t is_periodic;
  uint64_t node_count;
  uint64_t strut_count;
  /** Struts per cell of the tiling. Struts that coincide in neighbouring cells count once. */
  uint64_t tiled_strut_count;
  /** Total length of these struts in a cell of size 1. */
  double tiled_length;
  /** Nodes on the face at 0 of each axis. */
  uint64_t low_nodes[3];
  /** Nodes on the face at 1 of each axis. */
  uint64_t high_nodes[3];
  /** Nodes on both faces without a copy on the opposite face. */
  uint64_t unmatched_nodes[3];
  /** Nodes without a copy along at least one axis. */
  uint64_t unmatched_count;
} msq_unit_cell_report;

/** Counts the nodes and struts of a unit cell, and finds the nodes on its faces that do not meet a
 * node of the next cell. A cell that is not periodic may be used, but its struts may end at the
 * face.
 *
 * unmatched: receives the indices of the unmatched nodes, ascending, at most unmatched_room; NULL
 * if unmatched_room is 0. Nodes within 1e-9 of the cell size are equal. Cost: quadratic in the
 * numbers of nodes and struts, below a second. Errors: ARGUMENT, MEMORY. */
MSQ_API msq_status msq_unit_cell_info(const msq_unit_cell_def* cell, msq_unit_cell_report* report,
                                      uint32_t* unmatched, uint64_t unmatched_room);

/** Copies the nodes (node_count triples) and struts (strut_count pairs of node indices) of a unit
 * cell, in the order of strut_factors, for example to draw or modify a named cell. The counts must
 * equal those of msq_unit_cell_info. Errors: ARGUMENT, MEMORY. */
MSQ_API msq_status msq_unit_cell_geometry(const msq_unit_cell_def* cell, double* nodes,
                                          uint64_t node_count, uint32_t* struts,
                                          uint64_t strut_count);

/** A periodic strut lattice. */
typedef struct msq_lattice_def {
  uint32_t struct_size;
  /** An msq_unit_cell. Default MSQ_UNIT_CELL_BCC. Ignored with a library. */
  int32_t unit_cell;
  msq_neighbourhood grid;
  /** Radius of the struts in model units. A constant must be > 0, a field >= 0. No default. */
  msq_param radius;
  /** CUSTOM: node_count triples, in [0, 1]. */
  const double* nodes;
  /** 1 to 4096. */
  uint64_t node_count;
  /** CUSTOM: strut_count pairs of indices of different nodes. */
  const uint32_t* struts;
  /** 1 to 4096. A named cell needs it only with strut_factors. */
  uint64_t strut_count;
  /** As in msq_unit_cell_def. */
  const double* strut_factors;
  /** Library of cell_count unit cells, all with the same struct_size, with at most 4096 nodes and
   * 4096 struts in total. NULL (default): the unit cell above. */
  const msq_unit_cell_def* cells;
  /** 1 to 256. */
  uint32_t cell_count;
  /** The cell is divided into this many clusters along each axis to find the struts near points of
   * arrays. 1 (none) to 64. 0 (default): chosen by cost. Ignored with a library. Does not change
   * results. */
  uint32_t clusters;
  /** With a library: index of the unit cell of each neighbourhood cell. It is evaluated at the
   * cell's centre, rounded half up, and clamped to the library. */
  msq_param cell_choice;
  /** Cells whose size varies along an axis of the grid; grid.cell_size along that axis is ignored.
   * The nodes move with the cells; struts stay straight and keep their radius. Not with a library
   * of several unit cells. NULL (default): all cells have one size. */
  const msq_period_def* period;
  /** Warped cells. The nodes move with the cells. The struts between nodes stay straight and keep
   * their radius, so few cells around an axis make coarse rings. A cell may span at most 150
   * degrees: (1 + |shear_outwards| + |shear_along|) * 360 / count, and 180 / count_polar more if
   * SPHERICAL. There are as many whole cells as fit between the radii. Struts of the first and the
   * last cells reach beyond the radii by their own radius. Not with a period, nor with a library of
   * several unit cells. NULL (default): cells are boxes. */
  const msq_warp_def* warp;
} msq_lattice_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_lattice_def_init(msq_lattice_def* def, size_t size);

/** Creates a periodic strut lattice: all points whose distance to a strut of the tiled unit cell is
 * at most radius times the factor of the strut. def must not be NULL.
 *
 * Struts are capsules: circular in model units for any cell size, with round ends, and they reach
 * across cell borders. With a library, each cell has the struts of the unit cell that cell_choice
 * selects. If the nodes of two unlike neighbouring cells do not match (msq_lattice_faces), struts
 * end at the face.
 *
 * Cost: proportional to the struts that can reach one cell: milliseconds for the named cells,
 * seconds for thousands of struts as wide as cells, and the same again for the first array or
 * distance. With a period or a warp: the struts near a cell are found when the cell is first
 * evaluated, in tens of microseconds, and kept in the cell cache. Errors: ARGUMENT, LIMIT (radius
 * times the greatest factor above 4 times the smallest cell size; cell sizes that differ by more
 * than 2^20 times; library too large; a sampled map of more than 2^24 cells), MEMORY, UNSUPPORTED
 * (both a period and a warp; either of them with a library of several unit cells). */
MSQ_API msq_status msq_structure_lattice(msq_context* context, const msq_lattice_def* def,
                                         msq_structure** structure);

/** Faces between unlike cells of a lattice. */
typedef struct msq_lattice_faces_report {
  uint32_t struct_size;
  /** Axis of the grid normal to the first unmatched face: 0, 1 or 2. -1: there is none, and the
   * fields below cell are 0. */
  int32_t axis;
  /** Cells that were examined. */
  uint64_t cells;
  /** Faces between two of them with different unit cells. */
  uint64_t faces;
  /** Faces with a node on one side that has no copy on the other. */
  uint64_t unmatched;
  /** Index of the cell below the first unmatched face. The other cell is the next one along the
   * axis. Cells are ordered by z, then y, then x. */
  int32_t cell[3];
  uint32_t reserved;
  /** Library indices of the unit cells in these two cells. */
  uint32_t types[2];
  /** Centre of the face in model units. */
  double point[3];
} msq_lattice_faces_report;

/** Counts the faces between cells of a lattice whose unit cells have nodes there that do not match,
 * and finds the first such face.
 *
 * The cells are those with inner points in the box from min to max, in model units (for a model:
 * msq_model_bounds); for a rotated grid, those in the box's bounding box along the axes of the
 * grid. A lattice without a library has no such faces; msq_unit_cell_info returns whether it is
 * periodic. job NULL: no job. Cost: one evaluation of cell_choice per cell, one byte per cell of a
 * layer. Errors: ARGUMENT (also if the structure is not a lattice), CANCELLED, LIMIT (more than
 * 2^30 cells, or 2^24 cells from the origin of the grid), MEMORY, UNSUPPORTED (a lattice with a
 * period or a warp: it has no library). */
MSQ_API msq_status msq_lattice_faces(const msq_structure* lattice, const double min[3],
                                     const double max[3], msq_lattice_faces_report* report,
                                     msq_job* job);

/** Unit cells of plate lattices: triangles in the unit cube, in the order of face_factors. */
enum msq_plate_cell {
  /** Nodes and faces of the definition. */
  MSQ_PLATE_CELL_CUSTOM = 0,
  /** Simple cubic: planes {100}, the faces of the cube, 2 triangles each normal to x, y and z. */
  MSQ_PLATE_CELL_CUBIC = 1,
  /** Body-centred cubic: planes {110}, the 6 rectangles through opposite edges of the cube: 12
   * triangles. */
  MSQ_PLATE_CELL_BCC = 2,
  /** Face-centred cubic: planes {111}, the faces of the octet truss's tetrahedra and octahedra: 8
   * triangles between diagonals of the cube's faces. */
  MSQ_PLATE_CELL_FCC = 3,
  /** CUBIC, then FCC: 14 triangles. Thin plates are equally stiff in all directions if the first 6
   * triangles are 8 sqrt(3) / 9 = 1.5396 times as thick as the others. */
  MSQ_PLATE_CELL_CUBIC_OCTET = 4,
  /** Faces of space-filling truncated octahedra, MSQ_UNIT_CELL_KELVIN closed: 72 triangles, the
   * first 48 of hexagons, the others of squares. */
  MSQ_PLATE_CELL_KELVIN = 5
};

/** A periodic lattice of plates, or of plates and struts. */
typedef struct msq_plate_lattice_def {
  uint32_t struct_size;
  /** An msq_plate_cell. Default MSQ_PLATE_CELL_CUBIC. */
  int32_t plate_cell;
  msq_neighbourhood grid;
  /** Whole thickness of the plates in model units. A constant must be > 0, a field >= 0. No
   * default. */
  msq_param thickness;
  /** node_count triples, in [0, 1]: the nodes of CUSTOM plates and of CUSTOM struts. */
  const double* nodes;
  /** 1 to 4096. */
  uint64_t node_count;
  /** CUSTOM: face_count triples of indices of different nodes, not on a line: the area of a
   * triangle in model units must be at least 1e-5 of the square of its longest side. */
  const uint32_t* faces;
  /** 1 to 4096. A named cell needs it only with face_factors. */
  uint64_t face_count;
  /** Factor of the thickness for each face, 0.001 to 1000. NULL (default): all 1. */
  const double* face_factors;
  /** Radius of the struts in model units, >= 0. The constant 0 (default): no struts. */
  msq_param radius;
  /** Unit cell of the struts, an msq_unit_cell. Default MSQ_UNIT_CELL_CUBIC. Ignored without
   * struts. */
  int32_t unit_cell;
  uint32_t reserved;
  /** With unit_cell CUSTOM: strut_count pairs of indices of different nodes. */
  const uint32_t* struts;
  /** 1 to 4096. A named cell needs it only with strut_factors. */
  uint64_t strut_count;
  /** As in msq_unit_cell_def. */
  const double* strut_factors;
} msq_plate_lattice_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_plate_lattice_def_init(msq_plate_lattice_def* def, size_t size);

/** Creates a periodic lattice of plates: all points whose distance to a triangle of the tiled unit
 * cell is at most half of thickness times the factor of the face. A radius adds the struts of
 * unit_cell, as in msq_structure_lattice on the same grid. def must not be NULL.
 *
 * A plate has its thickness in model units for any cell size, has a round rim, and reaches across
 * cell borders. Faces that coincide in several copies count once, with the greatest of their
 * factors. Lattices of plates alone have an onset, which is a thickness. Those with struts have
 * none, so msq_structure_calibrate refuses them.
 *
 * Cost: proportional to the plates that can reach one cell: milliseconds for the named cells,
 * seconds for thousands of plates as thick as cells, and the same again for the first array, slice
 * or distance. Errors: ARGUMENT, LIMIT (thickness times the greatest factor, or radius times the
 * greatest factor, above 4 times the smallest cell size; cell sizes that differ by more than 2^20
 * times), MEMORY. Source: Tancogne-Dejean et al. 2018; Berger, Wadley and McMeeking 2017. */
MSQ_API msq_status msq_structure_plate_lattice(msq_context* context,
                                               const msq_plate_lattice_def* def,
                                               msq_structure** structure);

/** How sets, grids and slices of a foam are evaluated. All methods yield the same solid. POINT,
 * METHOD_1 and METHOD_2 are those of the paper, for comparison. docs/benchmarks.md compares their
 * cost. Single points (msq_point_membership) are always evaluated by the definition. */
enum msq_foam_method {
  /** The fastest method; now DIRECT. */
  MSQ_FOAM_AUTO = 0,
  /** The paper's naive query per point: gather seeds, form triplets with the nearest seed, project,
   * validate. */
  MSQ_FOAM_POINT = 1,
  /** Per cell: edges of a Delaunay triangulation (CGAL), kept in the cache. */
  MSQ_FOAM_METHOD_2 = 2,
  /** Each Voronoi edge is built once, kept in the cache, and rasterised as spans. Arrays of points,
   * and grids with few samples per cell, use the seeds near each point, grouped by cell, with SIMD.
   */
  MSQ_FOAM_DIRECT = 3,
  /** Per cell: lines of seed triplets, kept in the cache and validated per point. */
  MSQ_FOAM_METHOD_1 = 4
};

/** A Voronoi foam: open-cell (struts), closed-cell (walls), or with both. */
typedef struct msq_foam_def {
  uint32_t struct_size;
  /** An msq_foam_method. */
  int32_t method;
  msq_neighbourhood grid;
  /** Radius of the struts in model units. A constant must be > 0, a field >= 0. No default. With
   * walls, the constant 0 means no struts. */
  msq_param radius;
  /** 0: seeds at the cell centres. 1 (default): anywhere in their cells. */
  double jitter;
  /** Selects the foam. Default 0. */
  uint64_t seed;
  /** Seeds per cell volume, up to 32768. Values below 1 count as 1 (default). */
  msq_param density;
  /** Whole thickness of the walls between the cells of the foam, in model units, >= 0. The constant
   * 0 (default): no walls. */
  msq_param wall_thickness;
  /** Radius of the hole through the middle of each wall, in model units, >= 0. A field is evaluated
   * at the middle of the wall. Walls with less area than their hole stay whole. Radii below 1/512
   * of the largest cell size count as 0. The constant 0 (default): no holes. Otherwise
   * wall_thickness must not be the constant 0. */
  msq_param vent_radius;
  /** How much longer the cells of the foam are along each axis of the grid: 1/16 to 16, default 1.
   * The Voronoi diagram measures lengths along axis i divided by stretch[i]. Struts stay circular,
   * and walls keep their thickness. Only the proportions of the three numbers count; cell_size[i] /
   * stretch[i] may differ by a factor of up to 16. Turn the grid for other directions. */
  double stretch[3];
  /** The greatest radius of the seeds' spheres, in model units, from 0 (default) to the smallest
   * cell size. Each seed has a radius r from 0 to weight by a hash. A point p is in the cell of the
   * seed s for which |p - s|^2 - r^2 is least: this is the Laguerre tessellation (power diagram) of
   * the spheres. Cells then differ more in size, and some seeds have none. Seeds stay where they
   * are. 0: the Voronoi diagram. */
  double weight;
  /** Cells whose size varies along an axis of the grid, by a factor of at most 16; grid.cell_size
   * along that axis is ignored. The largest cell sizes along the three axes may differ by a factor
   * of up to 4. The seeds move with the cells, and the Voronoi diagram is that of the moved seeds.
   * Struts stay straight and keep their radius; walls keep their thickness. The limits of radius,
   * wall_thickness and vent_radius refer to the smallest cell size. With a period, method must be
   * AUTO or DIRECT, density must not exceed 1, the three numbers of stretch must be equal, and
   * weight must be 0. NULL (default): all cells have one size. */
  const msq_period_def* period;
  /** Cells around the z axis of the grid, around its origin, or by a sampled map. Each cell has a
   * seed, and the Voronoi diagram is that of the seeds in model space. Struts stay straight and
   * keep their radius; walls keep their thickness.
   *
   * CYLINDRICAL, SPHERICAL: outer_radius must be above 0. Around a point count must be at least 3
   * and count_polar at least 2. Cells go on beyond inner_radius and outer_radius, so those at the
   * two radii are like those between them. The foam is cut off there. Between the radii, cell sizes
   * may differ by a factor of up to 16: grid.cell_size[0]; the width 2 pi r / count at a distance r
   * from the axis, or at the equator; and grid.cell_size[2], or pi r / count_polar around a point.
   *
   * SAMPLED: the foam is cut off at the box of the samples. At the faces of this box, cells of the
   * foam differ in size from others: sample one cell more than the part needs. The smallest cell
   * size is 1 over the greatest slope of the map. The longest edge of a cell, in the middle of any
   * voxel, may be 16 times as long. The ranges of u, v and w, in whole cells, may have a product of
   * 2^24. The seeds count against the memory limit.
   *
   * The limits of radius, wall_thickness and vent_radius refer to the smallest cell. With a warp,
   * method must be AUTO or DIRECT, density must not exceed 1, the three numbers of stretch must be
   * equal, weight must be 0, and period must be NULL. NULL (default): cells are boxes. */
  const msq_warp_def* warp;
} msq_foam_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_foam_def_init(msq_foam_def* def, size_t size);

/** Creates a Voronoi foam of one jittered seed per neighbourhood cell: all points within radius of
 * an edge of the Voronoi diagram, or within half of wall_thickness of a face. def must not be NULL.
 *
 * Struts are capsules, circular in model units. Walls are plane; their thickness is measured across
 * the face. Foams with walls alone have an onset, which is a thickness. Those with struts and walls
 * have none, so msq_structure_calibrate refuses them. Seeds are a function of the cell index
 * and the seed number, equal on every machine. Where density exceeds 1, cells are subdivided 2x2x2
 * recursively. Each leaf has one jittered seed, and the mean number of seeds is the density
 * (docs/concepts.md). Cells are built by the calls that need them. Errors: ARGUMENT, LIMIT (radius,
 * wall_thickness, vent_radius or weight above the smallest cell size; cell sizes that differ by a
 * factor above 4, or in a period or a warp above 16; a warp with 2^15 seeds in a volume of about
 * the largest cell; a sampled map of more than 2^24 cells; stretch, see there; density above
 * 32768), UNSUPPORTED (METHOD_2 without CGAL; walls, a stretch, a weight, a period, a warp, or
 * density above 1, with a method other than AUTO and DIRECT; a stretch, a weight, a period or a
 * warp with density above 1; a stretch or a weight with vent_radius; two of stretch, weight, period
 * and warp), MEMORY. Source: paper, section "Preprocessing for Voronoi Foams"; Martinez, Dumas and
 * Lefebvre 2016. Weights: Imai, Iri and Murota, "Voronoi diagram in the Laguerre geometry and its
 * applications", 1985; Aurenhammer, "Power diagrams: properties, algorithms and applications",
 * 1987; for foams Fan, Wu, Zhao and Lu, "Simulation of polycrystalline structure with Voronoi
 * diagram in Laguerre geometry based on random closed packing of spheres", 2004. */
MSQ_API msq_status msq_structure_foam(msq_context* context, const msq_foam_def* def,
                                      msq_structure** structure);

/** Functions of functional structures. x, y, z are 2 pi times the position in the cell. */
enum msq_function {
  /** The expression of the definition. */
  MSQ_FUNCTION_EXPRESSION = 0,
  /** sin x cos y + sin y cos z + sin z cos x */
  MSQ_FUNCTION_GYROID = 1,
  /** cos x + cos y + cos z */
  MSQ_FUNCTION_SCHWARZ_P = 2,
  /** sin x sin y sin z + sin x cos y cos z + cos x sin y cos z + cos x cos y sin z */
  MSQ_FUNCTION_DIAMOND = 3,
  /** 2 (cos x cos y + cos y cos z + cos z cos x) - (cos 2x + cos 2y + cos 2z) */
  MSQ_FUNCTION_I_WP = 4,
  /** 3 (cos x + cos y + cos z) + 4 cos x cos y cos z */
  MSQ_FUNCTION_NEOVIUS = 5,
  /** 4 cos x cos y cos z - (cos 2x cos 2y + cos 2y cos 2z + cos 2z cos 2x) */
  MSQ_FUNCTION_F_RD = 6,
  /** 0.5 (sin 2x cos y sin z + sin 2y cos z sin x + sin 2z cos x sin y)
   * - 0.5 (cos 2x cos 2y + cos 2y cos 2z + cos 2z cos 2x) + 0.15 */
  MSQ_FUNCTION_LIDINOID = 7,
  /** 1.1 (sin 2x sin z cos y + sin 2y sin x cos z + sin 2z sin y cos x)
   * - 0.2 (cos 2x cos 2y + cos 2y cos 2z + cos 2z cos 2x) - 0.4 (cos 2x + cos 2y + cos 2z) */
  MSQ_FUNCTION_SPLIT_P = 8,
  /** cos 2x sin y cos z + cos 2y sin z cos x + cos 2z sin x cos y. */
  MSQ_FUNCTION_FISCHER_KOCH_S = 9,
  /** sin 2x sin y + sin 2y sin z + sin 2z sin x + sin 2x cos z + sin 2y cos x + sin 2z cos y
   * - sin x sin y sin z - cos x cos y cos z: C(Y). */
  MSQ_FUNCTION_C_Y = 10,
  /** sin 2x sin y + sin 2y sin z + sin 2z sin x - 2 cos x cos y cos z: C(+-Y). */
  MSQ_FUNCTION_C_PLUS_MINUS_Y = 11,
  /** 0.3 (cos x + cos y + cos z) + 0.3 (cos x cos y + cos y cos z + cos z cos x)
   * - 0.4 (cos 2x + cos 2y + cos 2z) + 0.2. */
  MSQ_FUNCTION_KARCHER_K = 12,
  /** sin 2x cos y sin z + sin 2y cos z sin x + sin 2z cos x sin y + 0.32: G'. */
  MSQ_FUNCTION_G_PRIME = 13,
  /** cos 2x cos 2y + cos 2y cos 2z + cos 2z cos 2x
   * - 2.75 (sin 2x cos y sin z + sin 2y cos z sin x + sin 2z cos x sin y) + 0.95. The network is
   *   two labyrinths that do not touch. So are the networks of the next two functions. */
  MSQ_FUNCTION_DOUBLE_GYROID = 14,
  /** -0.5 (sin x sin y + sin y sin z + sin z sin x) - 0.5 cos x cos y cos z. */
  MSQ_FUNCTION_DOUBLE_DIAMOND = 15,
  /** -0.5 (cos x cos y + cos y cos z + cos z cos x) - 0.2 (cos 2x + cos 2y + cos 2z). */
  MSQ_FUNCTION_DOUBLE_P = 16,
  /** cos 2y + 2 cos x cos y + 0.5: columns along z with hexagonal holes, regular if the cell is
   * sqrt(3) times as long along y as along x. */
  MSQ_FUNCTION_HONEYCOMB = 17,
  /** 1 - cos x - cos y: rods along z. */
  MSQ_FUNCTION_RODS = 18
};

/** Which points of a functional structure are solid. */
enum msq_functional_kind {
  /** Where the function is at most the level. */
  MSQ_FUNCTIONAL_NETWORK = 1,
  /** Where the magnitude of the function is at most the level. */
  MSQ_FUNCTIONAL_SHEET = 2
};

/** A functional structure. */
typedef struct msq_functional_def {
  uint32_t struct_size;
  /** An msq_function. Default MSQ_FUNCTION_GYROID. */
  int32_t function;
  /** An msq_functional_kind. Default MSQ_FUNCTIONAL_NETWORK. */
  int32_t kind;
  /** The cell is divided into this many clusters along each axis to decide whole blocks at once. 1
   * (none) to 64. 0 (default): chosen by cost. Does not change results. */
  uint32_t clusters;
  /** One period per cell. */
  msq_neighbourhood grid;
  /** Value of the function, not a length. Default 0. SHEET: a constant must be > 0, a field >= 0
   * and not 0 everywhere; or give thickness instead. */
  msq_param level;
  /** EXPRESSION: text in the grammar below. Otherwise NULL. */
  const char* expression;
  /** EXPRESSION: parameter_count names that the text may use. */
  const msq_named_value* parameters;
  /** At most 1024. */
  uint64_t parameter_count;
  /** SHEET, instead of level: mean wall thickness in model units. A constant must be > 0, a field
   * >= 0 and not 0 everywhere. With a period it must be a constant. Default 0: level is used. */
  msq_param thickness;
  /** Cells of varying size. NULL (default): all cells have the size of the grid. */
  const msq_period_def* period;
  /** Warped cells. NULL (default): cells are boxes. Not together with a period or a thickness. */
  const msq_warp_def* warp;
} msq_functional_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_functional_def_init(msq_functional_def* def, size_t size);

/** Creates a functional structure: the points where a function of the position in the cell is at
 * most a level. def must not be NULL.
 *
 * Expressions consist of numbers, pi, parameters, x, y, z, + - * / ^, parentheses, comparisons, and
 * pow(a, b), min(a, b), max(a, b), abs, sqrt, sin, cos, exp, log (natural), tanh, atan2(y, x),
 * hypot(a, b), floor, ceil, round, mod(a, b) and select(c, a, b). ^ binds tighter than a sign
 * before it and associates to the right. x, y and z are angles from 0 to 2 pi. A function that is
 * not periodic jumps at the cell border. Constant integer exponents from -65536 to 65536 are
 * evaluated as products, or 1 over one; a^0 is the constant 1. Other powers are exp(b log(a)), so
 * they need a > 0.
 * - Comparisons, < <= > >= == !=, bind weakest, do not associate, and are 1 or 0.
 * - select(c, a, b) is a where c is above 0.5, otherwise b.
 * - round(a) is floor(a + 0.5), ceil(a) is -floor(-a), mod(a, b) is a - b floor(a / b).
 * - atan2 is above -pi and at most pi, and 0 where x and y are 0. hypot is sqrt(a a + b b).
 *
 * A NaN operand makes the result NaN, also for min and max, in either order (minimum and maximum of
 * IEEE 754-2019). The operand that select does not choose is ignored. Points where the value is
 * NaN are outside. Limits: 65536 bytes; 100 nested parentheses, signs and exponents; 8192 distinct
 * operations, numbers and variables in total.
 *
 * Where floor, a comparison, select or atan2 may jump within the cell, the slope has no bound.
 * Distances to such a structure are 0. Rays cross jumps, poles and NaN in steps of up to 1/1024 of
 * a cell.
 *
 * Thickness is the volume of the walls divided by the area of their middle surface, where the
 * function is 0, in one cell. msq finds the level from a curve of 512 pieces through 65^3 values of
 * the function, accurate to about 0.3 % for the named functions (docs/concepts.md). Walls are
 * thicker where the function is flatter. A field of thickness selects at each point the level of
 * that thickness.
 *
 * With a period, the function is evaluated at the position in a cell of varying size. A level
 * applies to cells of all sizes, so walls grow with the cells. A thickness is kept: at each
 * position along the axis, msq uses the level that gives walls of this thickness in cells of the
 * size there. Then only the spacing varies. Fill lines follow the middle of the walls in both
 * cases. msq_fill_calibrate takes only structures without a period. Slices along the axes of the
 * grid cost as much as those of a structure without a period whose cell size is no multiple of the
 * pitch.
 *
 * With warped cells, the function is evaluated at the position in the cell, so walls are thicker
 * where cells are wider. A level that is a field of the radius can keep their thickness. Distances
 * are lower bounds, and 0 near the axis and the poles. Where rays have no bound of the function
 * there, they advance in steps of up to 1/1024 of a cell. Layers across or along the axis of
 * cylindrical cells are computed by rows, from tables of the function. Other layers are computed by
 * boxes, then by points, which takes 30 to 40 times as long. Fill lines end where the cells end.
 *
 * Functions use IEEE operations only, not the C library, so their bits are equal on every machine.
 * Cost: the first slice or grid makes clusters^3 interval evaluations (tens of milliseconds by
 * default, seconds for the longest expressions); a thickness takes tens of milliseconds at
 * construction, with a period up to a second. Errors: ARGUMENT (also: a thickness for a network, a
 * thickness together with a level, a thickness that fills the cell, a thickness for a function that
 * has no zero or is nowhere above 1e-300; a period whose positions do not ascend, or whose cell
 * sizes leave their limits, with the index; a warp that leaves its limits; for expressions the
 * message gives the position, from 1, and the reason), LIMIT (limits of expressions; more than 2^24
 * cells between the grid's origin and a position of the period), UNSUPPORTED (a field of thickness
 * with a period; a thickness or a period with a warp), MEMORY. Source: paper, section
 * "Preprocessing for Repeating Structures"; Schoen 1970; Fischer and Koch 1987; Karcher 1989; von
 * Schnering and Nesper 1991; Wohlgemuth et al. 2001; Fisher et al. 2023 (docs/prior_art.md). */
MSQ_API msq_status msq_structure_functional(msq_context* context, const msq_functional_def* def,
                                            msq_structure** structure);

/** A sum of waves. */
typedef struct msq_waves_def {
  uint32_t struct_size;
  /** An msq_functional_kind. Default MSQ_FUNCTIONAL_NETWORK. */
  int32_t kind;
  /** Picks the directions and phases. Default 0. */
  uint64_t seed;
  /** Number of waves, 1 to 4096. Default 256. */
  uint32_t count;
  /** Cells along each axis of the grid after which the structure repeats, up to 2^20. 0 (default):
   * it need not. Wave vectors are rounded to those that fit. */
  uint32_t tile[3];
  /** Half-angles of cones about the axes of the grid, in degrees: 0 (no cone) or 0.1 to 90, at
   * least one above 0. The waves have directions in these cones. Default 90, 0, 0: all directions.
   * One small cone: layers across the axis; two: columns along the third axis; three: a cubic
   * structure. */
  double cone_angles[3];
  /** cell_size: the wavelength along each axis of the grid. */
  msq_neighbourhood grid;
  /** Value of the sum, not a length. The sum has variance 1. Default 0: half of the volume.
   * SHEET: a constant must be > 0, a field >= 0 and not 0 everywhere. */
  msq_param level;
  /** In place of a level: the volume fraction of a Gaussian random field, above 0 and below 1. 0
   * (default): level is used. */
  double volume_fraction;
} msq_waves_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_waves_def_init(msq_waves_def* def, size_t size);

/** Creates a spinodal structure: the points where a sum of cosines of one wavelength, with random
 * directions and phases, is at most the level (NETWORK), or its magnitude is (SHEET). def must not
 * be NULL.
 *
 * Directions and phases are a function of the seed, equal on every machine. With many waves the sum
 * is a Gaussian random field. volume_fraction is then met on average: the level is the inverse of
 * the normal distribution. Samples of few wavelengths and sums of few waves differ from it;
 * msq_structure_calibrate finds the level for a sample. A grid with different cell sizes stretches
 * the structure. docs/concepts.md defines the sum.
 *
 * Cost: where a wavelength has 60 samples, a sample of a slice or a grid takes 0.5 ns, and 0.1 ns
 * more for each 100 waves; any other point takes about 2 ns for each wave. Errors: ARGUMENT
 * (also: both a level and a volume fraction), MEMORY. Source: Cahn 1965; Kumar, Tan, Zheng and
 * Kochmann 2020. */
MSQ_API msq_status msq_structure_waves(msq_context* context, const msq_waves_def* def,
                                       msq_structure** structure);

/** How a beam ends. */
enum msq_cap {
  /** With a ball of the radius at that end. If the radii differ, the ball of the thicker end
   * protrudes from the side of the beam. */
  MSQ_CAP_SPHERE = 0,
  /** With the half of that ball beyond the end. */
  MSQ_CAP_HEMISPHERE = 1,
  /** Flat. */
  MSQ_CAP_BUTT = 2
};

/** A list of beams. Strides are bytes from one element to the next; 0 (default): tightly packed. No
 * alignment is needed. */
typedef struct msq_beams_def {
  uint32_t struct_size;
  /** An msq_cap for all ends, unless caps is given. Default MSQ_CAP_SPHERE. */
  int32_t cap;
  /** Of nodes, radii and ball_radii: MSQ_FLOAT32 or MSQ_FLOAT64 (default). */
  int32_t coordinate_type;
  /** Must be 0. */
  uint32_t reserved;
  /** node_count triples x, y, z. */
  const void* nodes;
  uint64_t node_count;
  uint64_t node_stride;
  /** beam_count pairs of node indices. */
  const uint32_t* beams;
  uint64_t beam_count;
  uint64_t beam_stride;
  /** beam_count pairs: radius at the first and at the second node. NULL (default): radius. */
  const void* radii;
  uint64_t radius_stride;
  /** beam_count pairs of msq_cap, at the first and at the second node. NULL (default): cap. */
  const uint8_t* caps;
  uint64_t cap_stride;
  /** ball_count node indices: balls in addition to those of the caps. */
  const uint32_t* balls;
  uint64_t ball_count;
  uint64_t ball_stride;
  /** ball_count numbers. NULL (default): ball_radius. */
  const void* ball_radii;
  uint64_t ball_radius_stride;
  /** Radius of all beams if radii is NULL. No default. */
  double radius;
  /** Radius of all balls if ball_radii is NULL. No default. */
  double ball_radius;
  /** In model units. Shorter beams are dropped. Default 0. */
  double min_length;
  /** Characteristic length of the scale. 0 (default): the longest beam, or the largest diameter if
   * that is more. */
  double length_scale;
} msq_beams_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_beams_def_init(msq_beams_def* def, size_t size);

/** Creates a structure of beams: the points in at least one beam or ball of a list. It has no grid
 * and is empty elsewhere. def must not be NULL. job NULL: no job.
 *
 * A beam is a conical frustum between two nodes, with a radius that is linear along its axis, and
 * caps. A beam shorter than 1e-100 has no axis: its round caps are balls; with two flat caps it is
 * dropped. Beams may overlap and repeat. Limits: 2^31 - 1 beams and balls in total; coordinates up
 * to 1e75; radii 0 or from 1e-100 to 1e75. One radius of a beam may be 0; that of a ball may not.
 * Cost: n log n, in parallel: about 0.3 us of processor time and 104 bytes per beam, of which 77
 * are kept. These bytes count against the memory limit of the context. Queries search a tree of
 * boxes. Errors: ARGUMENT (also, with its index: a node that is not finite; a node index, radius or
 * cap out of range), CANCELLED, LIMIT, MEMORY. Source: 3MF Consortium, "Beam Lattice Extension"
 * 1.2.0; Kamel and Faloutsos, "On packing R-trees", 1993. */
MSQ_API msq_status msq_structure_beams(msq_context* context, const msq_beams_def* def,
                                       msq_structure** structure, msq_job* job);

/** The beam lattices of a file, and its mesh. Immutable; any thread may read it. */
typedef struct msq_beam_file msq_beam_file;

/** Reads beam lattices from a 3MF file. def NULL: defaults; format must be MSQ_FORMAT_AUTO or
 * MSQ_FORMAT_3MF. job NULL: no job. path as in msq_shape_from_file.
 *
 * A file has one or more lattices. Each makes a structure of its own (msq_beam_file_beams). Lattice
 * 0 has all beams and balls of the build that no mesh clips. Each placed object whose beams a mesh
 * clips is one more lattice. Everything is in millimetres and placed: units and transforms of items
 * and components are applied. In the file a solid of beams is united with the triangles of its
 * object; msq_beam_file_shape makes a shape of all triangles of the build.
 *
 * msq reads vertices, beams, radii at the ends, caps, balls and their three modes, minlength
 * (shorter beams are dropped) and the clipping mode with its mesh. In ball mode "all", the vertices
 * at which beams end have balls. Beam sets, properties and representation meshes do not change the
 * solid and are ignored. Numbers become the nearest doubles.
 *
 * Limits: those of def; max_triangles is also the maximum number of beams and balls, and of
 * triangles that clip. Cost: linear in the size of the file, about 1 us per beam on one thread.
 * Memory: 44 bytes per beam and 24 per node are kept; reading takes up to ten times that.
 * Errors: as msq_shape_from_file; UNSUPPORTED also for another format, a clipping mesh that has
 * components or beams, and transforms that scale some directions by over 1e-4 more than others;
 * MESH also for a file without beams, and for a node or radius that msq_structure_beams refuses.
 * Source: 3MF Consortium, "Beam Lattice Extension" 1.2.0. */
MSQ_API msq_status msq_beam_file_open(msq_context* context, const char* path,
                                      const msq_file_def* def, msq_beam_file** file, msq_job* job);

/** Reads beam lattices from bytes in memory. def must name the format and must not be NULL. See
 * msq_beam_file_open. Errors: as msq_beam_file_open. */
MSQ_API msq_status msq_beam_file_open_memory(msq_context* context, const void* data, uint64_t bytes,
                                             const msq_file_def* def, msq_beam_file** file,
                                             msq_job* job);
/** Adds a reference. */
MSQ_API void msq_beam_file_retain(msq_beam_file* file);
/** Drops a reference. */
MSQ_API void msq_beam_file_release(msq_beam_file* file);

/** Which part of the beams of a file belongs to the solid. */
enum msq_clipping {
  MSQ_CLIPPING_NONE = 0,
  /** The part inside the clipping mesh. */
  MSQ_CLIPPING_INSIDE = 1,
  /** The part outside the clipping mesh. */
  MSQ_CLIPPING_OUTSIDE = 2
};

/** Contents of a lattice of a file. */
typedef struct msq_beam_file_report {
  uint32_t struct_size;
  /** An msq_clipping. */
  int32_t clipping;
  /** Lattices of the file. */
  uint64_t lattice_count;
  /** Triangles of the build. 0: there is no mesh. */
  uint64_t mesh_triangle_count;
  /** The following members describe the lattice. */
  uint64_t node_count;
  uint64_t beam_count;
  uint64_t ball_count;
  /** Triangles of the clipping mesh. */
  uint64_t clipping_triangle_count;
  /** Corners of a box that contains all beams and balls, in millimetres. Not clipped. */
  double min[3];
  double max[3];
} msq_beam_file_report;

/** Reports the contents of a lattice of a file. Errors: ARGUMENT (lattice is not less than
 * lattice_count). */
MSQ_API msq_status msq_beam_file_info(const msq_beam_file* file, uint64_t lattice,
                                      msq_beam_file_report* report);

/** Fills in the definition of a lattice for msq_structure_beams, unclipped. The caller sets
 * struct_size. The arrays of the definition belong to the file and are valid as long as it is; the
 * other fields have their defaults. Errors: ARGUMENT (lattice is not less than lattice_count). */
MSQ_API msq_status msq_beam_file_beams(const msq_beam_file* file, uint64_t lattice,
                                       msq_beams_def* def);

/** A mesh of a file of beams. */
enum msq_beam_file_mesh {
  /** All triangles of the build: what is solid besides the beams. lattice must be 0. */
  MSQ_BEAM_FILE_SOLID = 0,
  /** The mesh that clips the lattice. */
  MSQ_BEAM_FILE_CLIPPING = 1
};

/** Creates a shape from a mesh of a file of beams, in millimetres. mesh: an msq_beam_file_mesh.
 * winding_rule: an msq_winding. Cost and errors: as msq_shape_from_mesh; ARGUMENT also for
 * lattice; MESH if the file has no such mesh. */
MSQ_API msq_status msq_beam_file_shape(msq_context* context, const msq_beam_file* file,
                                       uint64_t lattice, int32_t mesh, int32_t winding_rule,
                                       msq_shape** shape);

/** Points that a host structure evaluates. Valid until the callback returns. */
typedef struct msq_host_points {
  /** Out: sizeof(msq_host_points) of the library. */
  uint32_t struct_size;
  uint32_t reserved;
  /** At most 4096. */
  uint64_t count;
  /** Triples x, y, z in model coordinates. */
  const double* points;
  /** Triples: offset from the corner of the point's cell, in model units along the axes of the
   * grid, from 0 to the cell size. */
  const double* positions;
  /** Triples i, j, k: the cell of each point. */
  const int32_t* cells;
} msq_host_points;

/** Writes inside[i]: 0 if point i is outside, any other value if it is inside or on the boundary.
 */
typedef int32_t (*msq_points_inside_fn)(void* user, const msq_host_points* points, uint8_t* inside);

/** Writes distances[i]: a lower bound on the distance from point i to the boundary, on either side,
 * with Lipschitz constant 1. The sign is ignored. */
typedef int32_t (*msq_points_distance_fn)(void* user, const msq_host_points* points,
                                          double* distances);

/** Builds the data of a cell. *data: the data, may be NULL. *bytes: its size in memory. */
typedef int32_t (*msq_build_cell_fn)(void* user, const int32_t cell[3], void** data,
                                     uint64_t* bytes);

/** As msq_points_inside_fn, for points in the one cell that data belongs to. */
typedef int32_t (*msq_evaluate_cell_fn)(void* user, const void* data, const msq_host_points* points,
                                        uint8_t* inside);

/** Frees data of a cell. data is not NULL. */
typedef void (*msq_free_cell_fn)(void* user, void* data);

/** Membership of all points of a box. */
enum msq_box_answer {
  /** Unknown, or neither of the others. */
  MSQ_BOX_MIXED = 0,
  MSQ_BOX_OUTSIDE = 1,
  MSQ_BOX_INSIDE = 2
};

/** Writes *answer, an msq_box_answer, for the closed box from min to max in model coordinates. */
typedef int32_t (*msq_box_fn)(void* user, const double min[3], const double max[3],
                              int32_t* answer);

/** A structure that the host computes. inside, or both build_cell and evaluate_cell, must be given.
 * If all are given, inside evaluates single points and evaluate_cell sets. */
typedef struct msq_host_structure_def {
  uint32_t struct_size;
  /** 0 (default) or 1. See "Objects that the host defines". */
  int32_t concurrent;
  msq_neighbourhood grid;
  msq_points_inside_fn inside;
  msq_build_cell_fn build_cell;
  msq_evaluate_cell_fn evaluate_cell;
  /** May be NULL. */
  msq_free_cell_fn free_cell;
  /** May be NULL. With it, msq skips the points of boxes without boundary. */
  msq_box_fn box;
  /** May be NULL: the distance bound is then 0, which is correct but does not help sphere tracing.
   */
  msq_points_distance_fn distance;
  void* user;
  /** May be NULL. */
  msq_release_fn release;
  /** Represents the callbacks in hashes. Both 0 (default): no key. */
  uint64_t hash_key[2];
} msq_host_structure_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_host_structure_def_init(msq_host_structure_def* def, size_t size);

/** Creates a structure from callbacks. def must not be NULL. Every function of msq works with
 * inside alone.
 *
 * A cell is built when a point in it is evaluated, and kept as long as the cache of the context
 * keeps it. Two threads may build the same cell at once. Evicted cells are freed when the next cell
 * is built, or with the structure. evaluate_cell has the data of one cell only: the data must
 * include all that reaches into the cell from its neighbours. Cost: sets, grids and slices call
 * back with batches, grouped by cell if build_cell is given. Single points and distances call back
 * point by point.
 * Errors: ARGUMENT, MEMORY. Calls that use the structure: HOST.
 * Source: paper, section "Multiscale Shape-Material Modeling API". */
MSQ_API msq_status msq_structure_host(msq_context* context, const msq_host_structure_def* def,
                                      msq_structure** structure);

/** A functional structure whose function the host computes. */
typedef struct msq_host_function_def {
  uint32_t struct_size;
  /** 0 (default) or 1. See "Objects that the host defines". */
  int32_t concurrent;
  /** An msq_functional_kind. Default MSQ_FUNCTIONAL_NETWORK. */
  int32_t kind;
  /** As in msq_functional_def. Ignored if neither range nor lipschitz is given. */
  uint32_t clusters;
  /** One period per cell. */
  msq_neighbourhood grid;
  /** As in msq_functional_def. */
  msq_param level;
  /** Values at triples of angles: 2 pi times the position in the cell, 0 to 2 pi. */
  msq_values_fn evaluate;
  /** Bounds over a box of angles, from -1e-9 to 2 pi + 1e-9. NULL (default): derived from
   * lipschitz. */
  msq_range_fn range;
  void* user;
  msq_release_fn release;
  /** Lipschitz constant of the values with respect to the angles. Infinity (default): unknown. */
  double lipschitz;
  /** Represents the callbacks in hashes. Both 0 (default): no key. */
  uint64_t hash_key[2];
} msq_host_function_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_host_function_def_init(msq_host_function_def* def, size_t size);

/** Creates a functional structure from callbacks, see msq_structure_functional. def must not be
 * NULL. The function may be infinite but not NaN. With range or lipschitz, blocks that are entirely
 * inside or outside are decided without evaluating points. Distances to its surface are 0. Cost:
 * clusters^3 calls of range (32768 by default), and as many points of evaluate with lipschitz.
 * Errors: ARGUMENT, HOST, MEMORY. Calls that use the structure: HOST. Source: paper, section
 * "Preprocessing for Repeating Structures". */
MSQ_API msq_status msq_structure_host_function(msq_context* context,
                                               const msq_host_function_def* def,
                                               msq_structure** structure);

/** Creates the union, intersection or difference of structures (operation: an
 * msq_boolean_operation) from their memberships. structures: count structures, 1 to 4096, each on
 * its own grid or on none. They may be of any kind, also made of structures themselves.
 *
 * The characteristic length is the largest of theirs. Hits of rays name no cell. msq_fill_calibrate
 * refuses the result: call it for the structures themselves. Unions of structures with struts have
 * struts, and an onset if all of them have one (msq_structure_struts, msq_set_onset). Distance of a
 * union: the smallest of their signed distances, exact outside if theirs are, a bound inside. Of an
 * intersection: the largest, a bound. Of a difference: that of the intersection with complements.
 * The limit on cells (2^24 from the origin of the grid) applies to each of their grids. Cost: the
 * sum of theirs. Errors: ARGUMENT, LIMIT (more than 64 structures made of structures within each
 * other; more than 4096 structures in total, counted with repetition), MEMORY. */
MSQ_API msq_status msq_structure_boolean(int32_t operation, const msq_structure* const* structures,
                                         uint64_t count, msq_structure** structure);

/** Creates a structure that changes from a to b. fraction: f, a number or a field, 0 to 1. Where f
 * is 0 the solid is that of a; where f is 1 it is that of b. In between, the points with
 * (1 - f) da + f db <= 0 are solid, where da and db are the signed distances of a and b as msq
 * returns them (docs/accuracy.md). So points in both are solid and points in neither are not.
 * Surfaces move from those of a to those of b as f grows. On the same grid with like nodes struts
 * stay whole; otherwise parts of a shrink while parts of b grow.
 *
 * Characteristic length, hits and limits on cells are as for msq_structure_boolean. Distance: a
 * bound, with Lipschitz constant 1 if f has one. Rays march by it. Cost: the sum of theirs, and two
 * distances at each sample that is in only one of them and has 0 < f < 1. The cost of a point is
 * linear in the number of structures, also if blends and smooth booleans are nested. Sets and
 * layers take the distance of a structure up to once for each blend or smooth boolean around it.
 * Errors: ARGUMENT (also a fraction that leaves 0 to 1), LIMIT (as msq_structure_boolean),
 * UNSUPPORTED (a distance of a or b has no Lipschitz constant: their radius, level or thickness is
 * a field without one, a function has no bounded slope, or the host gives no distance), MEMORY. */
MSQ_API msq_status msq_structure_blend(const msq_structure* a, const msq_structure* b,
                                       const msq_param* fraction, msq_structure** structure);

/** Creates the union, intersection or difference (operation: an msq_boolean_operation; the
 * difference is a without b) of two structures, with fillets where their surfaces meet. radius: k,
 * a number or a field in model units, at least 0. Where it is 0 the solid is that of
 * msq_structure_boolean. With the signed distances u and v to a and b as msq returns them
 * (docs/accuracy.md), h = max(0, k - |u - v|) and s = min(u, v) - h^2 / (4 k), the union is the set
 * of points with s <= 0. An intersection takes -u and -v, a difference -u and v, and both are the
 * sets of points with s >= 0. So a union gains, and the others lose, points with sqrt(|u|) +
 * sqrt(|v|) <= sqrt(k): only where both surfaces are nearer than k. Between two planes at right
 * angles the fillet is a parabola that touches both at the distance k from their edge.
 *
 * Characteristic length, hits and limits on cells are as for msq_structure_boolean. Distance: a
 * bound, |s| / (1 + L / 4) for a radius with Lipschitz constant L. Rays march by it. Cost: that of
 * msq_structure_boolean, and some distances near the fillets. Nested ones cost as in
 * msq_structure_blend. Errors: ARGUMENT (also a radius that may be negative), LIMIT (as
 * msq_structure_boolean), UNSUPPORTED (a distance of a or b has no Lipschitz constant, as for
 * msq_structure_blend), MEMORY. */
MSQ_API msq_status msq_structure_smooth_boolean(int32_t operation, const msq_structure* a,
                                                const msq_structure* b, const msq_param* radius,
                                                msq_structure** structure);

/** Hashes a structure, as msq_shape_hash does. The method of a foam and clusters do not count.
 * Errors: as msq_shape_hash. */
MSQ_API msq_status msq_structure_hash(const msq_structure* structure, uint8_t hash[16]);
/** Adds a reference. */
MSQ_API void msq_structure_retain(msq_structure* structure);
/** Drops a reference. */
MSQ_API void msq_structure_release(msq_structure* structure);

/* ---- Struts ---------------------------------------------------------------------------------- */

/** Which struts a box selects. */
enum msq_struts_selection {
  /** The struts whose middle is in the half-open box: min <= middle < max along each axis. Boxes
   * that tile a region share no strut, and together they have those of the region. The middle is
   * half the sum of the ends, rounded. */
  MSQ_STRUTS_OWNED = 0,
  /** All struts that come near the closed box: the centre line meets the box, grown on all sides by
   * the greatest radius that the strut may have. Every strut with a point in the box is among them.
   * A strut may come near several boxes. */
  MSQ_STRUTS_NEAR = 1
};

/** A strut, or a piece of one: a segment of the centre lines of a structure. Two struts, or two
 * nodes, are the same if and only if both numbers of their ids are equal. */
typedef struct msq_strut {
  /** Depends on the definition of the structure alone, not on the box, threads or machine. */
  uint64_t id[2];
  /** Id of the node at a. Struts that meet in a node have the same id there, and the same
   * coordinates, bit for bit. */
  uint64_t node_a[2];
  /** Id of the node at b. */
  uint64_t node_b[2];
  /** First end in model units. */
  double a[3];
  /** Second end. */
  double b[3];
  /** Radius at a and at b, in model units. A field of radius is evaluated at the ends. */
  double radii[2];
  /** Cell of the grid that owns the strut. Beams: 0. */
  int32_t cell[3];
  /** An msq_cap for each end. MSQ_CAP_SPHERE except for beams. */
  uint8_t caps[2];
  /** 1: this end is where the strut leaves the shape. 0: a node of the structure. */
  uint8_t cut[2];
} msq_strut;

/** Receives count struts, valid until the callback returns. A return value other than 0 stops the
 * call with MSQ_E_HOST. */
typedef int32_t (*msq_struts_fn)(void* user, const msq_strut* struts, uint64_t count);

/** Selects struts of a structure. */
typedef struct msq_struts_def {
  uint32_t struct_size;
  /** An msq_struts_selection. Default MSQ_STRUTS_OWNED. */
  int32_t selection;
  /** Corners of the box in model units, min <= max. Default 0. */
  double min[3];
  double max[3];
  /** Struts are cut to this shape. NULL (default): they are not cut. Whole struts are selected, so
   * pieces of one strut come together. */
  const msq_shape* shape;
} msq_struts_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_struts_def_init(msq_struts_def* def, size_t size);

/** Passes the struts of a lattice, a foam with struts or beams that a box selects to a callback:
 * for beam models of finite elements, for 3MF, or for drawing.
 *
 * Lattices: the struts of the tiled unit cell, each once. Where struts coincide, the greatest
 * factor counts. Equal nodes, within 1e-9 of the cell size, are one node, with the position of the
 * first. Foams: the edges of the Voronoi diagram. A node is a point equally far from four or more
 * seeds; its id comes from their names. Which seeds are equally far is decided exactly, at any
 * jitter. Node positions are computed from the seeds in double precision. Where seeds are almost on
 * one sphere, as with a jitter of 1e-9 to 1e-5, two nodes may be so close that the strut between
 * them has equal ends. An id that would need more than 128 bits is a hash, which msq assumes to be
 * unique. Beams: all beams and balls. A ball has equal a and b. Ends at the same coordinates are
 * one node. id[0] is the index of the beam in the definition; balls are numbered after the beams.
 * Foams with struts and walls: the struts. Unions: the struts of all members, one member after the
 * other, with hashes of the members' ids as ids; cell is that of the member. Nodes of two members
 * stay distinct, even where they coincide.
 *
 * With a shape, msq passes the parts of a strut's centre line that are inside the shape, in the
 * order from a to b. Each cut end is inside the shape, within 2^-36 of the shape's size and
 * coordinates of the place where membership changes on the line. Cut ends are found as the hits of
 * rays are (msq_ray_cast). Parts and gaps shorter than that may be missed. The solid around the
 * line is not cut. Radii at cut ends are evaluated there. The first piece has the id of the strut.
 * Each other piece has an id of its own, and each cut end a node of its own.
 *
 * The order of struts and their bytes are the same on every call and on any number of threads.
 * callback runs on the calling thread, with up to 4096 struts at once. It may call msq. def must
 * not be NULL. job NULL: no job. The threads are those of the context. Memory: some megabytes, and
 * the cells of foams in the cache. Cost: parallel; tens of nanoseconds per strut of lattices and
 * beams, microseconds per strut of foams, whose cells are built. A tile of a foam also builds cells
 * around it. Errors: ARGUMENT, UNSUPPORTED (functional and host structures, foams of walls alone,
 * and structures made of others, except unions of those with struts: they have no struts), LIMIT (a
 * box beyond 2^24 cells from the origin of the grid, or of 2^63 blocks of cells), HOST, CANCELLED,
 * MEMORY. Source: 3MF Consortium, "Beam Lattice Extension" 1.2.0; Voronoi diagrams: Aurenhammer
 * 1991. */
MSQ_API msq_status msq_structure_struts(msq_context* context, const msq_structure* structure,
                                        const msq_struts_def* def, msq_struts_fn callback,
                                        void* user, msq_job* job);

/** Struts as arrays, joined at numbered nodes. Immutable; any thread may read it. */
typedef struct msq_strut_graph msq_strut_graph;

/** Collects the struts that msq_structure_struts passes, in the same order, and numbers their nodes
 * in the order in which they first occur. Cost: as msq_structure_struts, and a table of the nodes
 * on the calling thread. Memory: 56 bytes per strut and 40 per node, accounted to the context;
 * while the call lasts, up to four times as much. Errors: as msq_structure_struts; LIMIT also for
 * memory or more than 2^32 - 2 nodes. */
MSQ_API msq_status msq_structure_strut_graph(msq_context* context, const msq_structure* structure,
                                             const msq_struts_def* def, msq_strut_graph** graph,
                                             msq_job* job);
/** Adds a reference. */
MSQ_API void msq_strut_graph_retain(msq_strut_graph* graph);
/** Drops a reference. */
MSQ_API void msq_strut_graph_release(msq_strut_graph* graph);

/** Contents of a graph of struts. Pointers are valid as long as the graph is. */
typedef struct msq_strut_graph_report {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t node_count;
  uint64_t strut_count;
  /** node_count triples x, y, z in model units. */
  const double* nodes;
  /** node_count pairs, as in msq_strut. */
  const uint64_t* node_ids;
  /** strut_count pairs of indices of nodes: at a and at b. */
  const uint32_t* struts;
  /** strut_count pairs: radius at a and at b. */
  const double* radii;
  /** strut_count pairs, as in msq_strut. */
  const uint64_t* strut_ids;
  /** strut_count triples, as in msq_strut. */
  const int32_t* cells;
  /** strut_count pairs of msq_cap. */
  const uint8_t* caps;
  /** strut_count pairs: 1 for an end where the strut leaves the shape. */
  const uint8_t* cuts;
} msq_strut_graph_report;

/** Reports the contents of a graph. Errors: ARGUMENT. */
MSQ_API msq_status msq_strut_graph_info(const msq_strut_graph* graph,
                                        msq_strut_graph_report* report);

/* ---- Materials ------------------------------------------------------------------------------- */

/** An id and named channels, for example density, modulus or colour. */
typedef struct msq_material msq_material;

/** Material id of points outside the model. */
enum msq_material_id { MSQ_MATERIAL_VOID = 0 };

/** A named channel of a material. */
typedef struct msq_channel {
  /** 1 to 255 bytes. */
  const char* name;
  msq_param value;
} msq_channel;

/** A material. */
typedef struct msq_material_def {
  uint32_t struct_size;
  /** Positive. The host chooses its meaning. No default. */
  uint32_t id;
  /** channel_count channels with distinct names. */
  const msq_channel* channels;
  /** At most 256. */
  uint64_t channel_count;
} msq_material_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_material_def_init(msq_material_def* def, size_t size);

/** Creates a material. def must not be NULL. Errors: ARGUMENT, MEMORY.
 * Source: paper, section "Multiscale Shape-Material Modeling API". */
MSQ_API msq_status msq_material_create(msq_context* context, const msq_material_def* def,
                                       msq_material** material);

/** Creates a blend of two materials: each channel is (1 - f) * a + f * b, where f is the fraction
 * at the point, 0 to 1 everywhere. id: the id of the blend, positive. Errors: ARGUMENT (also if one
 * material has a channel that the other lacks), LIMIT (more than 64 nested blends, or more than
 * 4096 materials in a blend, counted with repetition), MEMORY. */
MSQ_API msq_status msq_material_blend(msq_context* context, uint32_t id, const msq_material* a,
                                      const msq_material* b, const msq_param* fraction,
                                      msq_material** material);
/** Hashes a material, as msq_shape_hash does: its id, and its channels in their order. Errors: as
 * msq_shape_hash. */
MSQ_API msq_status msq_material_hash(const msq_material* material, uint8_t hash[16]);
/** Adds a reference. */
MSQ_API void msq_material_retain(msq_material* material);
/** Drops a reference. */
MSQ_API void msq_material_release(msq_material* material);

/* ---- Model ----------------------------------------------------------------------------------- */

/** A coarse shape and the structures that fill it, scale by scale. */
typedef struct msq_model msq_model;

/** One scale of a model. Zero-initialise it, then set what you need; fields may be added. */
typedef struct msq_scale_def {
  /** Scale 0: the shape. Other scales: NULL. */
  const msq_shape* shape;
  /** Scales 1 and finer: the structure. Scale 0: NULL. */
  const msq_structure* structure;
  /** Thickness, in model units, of the solid skin that the scale leaves under the surface of the
   * coarse shape. At least 0 everywhere. 0: none. Not for scale 0, nor in shapes without depth. */
  msq_param skin;
  /** Material of what the scale resolves. NULL: that of the next coarser scale. */
  const msq_material* material;
  /** Material of the skin. NULL: material. Not for scale 0. */
  const msq_material* skin_material;
} msq_scale_def;

/** A model. */
typedef struct msq_model_def {
  uint32_t struct_size;
  /** 1 to 64. */
  uint32_t scale_count;
  /** Coarsest first: a shape, then structures. */
  const msq_scale_def* scales;
  /** sizeof(msq_scale_def) of the caller. A multiple of 8. 0 (default): that of version
   * 0.2. */
  uint32_t scale_size;
  /** Must be 0. */
  uint32_t reserved;
} msq_model_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_model_def_init(msq_model_def* def, size_t size);

/** Creates a model: the intersection of the shape with every structure. Where a scale leaves a
 * skin, the union of structure and skin takes the place of the structure. def must not be NULL.
 *
 * The skin is the set of points of the shape whose depth is at most the thickness at the point,
 * where the thickness is above 0. Depth is the distance to the boundary of the shape, as in
 * msq_point_distance. Primitives and meshes have depth; voxel images, host shapes and some shapes
 * made of shapes only bound the distance. Cost: constant; with a skin on a mesh, the first call
 * that needs it builds a tree of the triangles. Errors: ARGUMENT, LIMIT (the shape has bounds and
 * reaches 2^24 cells from the origin of a structure's grid), UNSUPPORTED (a skin in a shape without
 * depth: docs/concepts.md), MEMORY. Source: paper, section "Multiscale Shape-Material Modeling
 * API"; the paper has no skin.
 */
MSQ_API msq_status msq_model_create(msq_context* context, const msq_model_def* def,
                                    msq_model** model);
/** Creates a model of several regions, for example the parts of a plate and the modifier volumes in
 * them. regions: count models, 1 to 4096; each has its own shape, scales, skins and materials.
 *
 * A point belongs to the first region whose shape contains it, and is inside if it is inside that
 * region. Later regions are ignored there, also where the region is empty. A region that is itself
 * a model of regions is replaced by these, in their order. All functions take the model: one slice,
 * ray or query serves a whole plate. Its coarse shape is the union of those of its regions. Scales
 * are numbered by region: hits name the scale of the region that they are in, and
 * msq_model_scale_length returns the largest length of any region.
 *
 * Cost: constant. In sets, slices and grids, a sample costs the memberships in the shapes before
 * its region, and the evaluation of its region. Slabs take two more bits per sample. Errors:
 * ARGUMENT, LIMIT (more than 4096 regions), UNSUPPORTED (a region of all space), MEMORY. */
MSQ_API msq_status msq_model_regions(msq_context* context, const msq_model* const* regions,
                                     uint64_t count, msq_model** model);
/** Hashes a model, as msq_shape_hash does: its shape, and the structure, skin and materials of each
 * scale; or its regions in their order. Errors: as msq_shape_hash. */
MSQ_API msq_status msq_model_hash(const msq_model* model, uint8_t hash[16]);
/** Adds a reference. */
MSQ_API void msq_model_retain(msq_model* model);
/** Drops a reference. */
MSQ_API void msq_model_release(msq_model* model);

/** Returns the bounding box of the coarse shape, which contains the model; for regions, the box
 * around all of them. Infinite for msq_shape_all_space. Errors: ARGUMENT. */
MSQ_API msq_status msq_model_bounds(const msq_model* model, double min[3], double max[3]);

/** Returns the characteristic length of a scale: its largest cell size; the length_scale of beams,
 * which have no cells; infinity for scale 0.
 * Errors: ARGUMENT (no such scale). */
MSQ_API msq_status msq_model_scale_length(const msq_model* model, uint32_t scale, double* length);

/** Returns the shape of scale 0, or the structure of another scale. The output that the scale does
 * not have receives NULL. The caller releases the handle. region: its index, from 0; 0 for a model
 * without regions. shape, structure NULL: not wanted. Errors: ARGUMENT (no such
 * region or scale). */
MSQ_API msq_status msq_model_scale(const msq_model* model, uint32_t region, uint32_t scale,
                                   msq_shape** shape, msq_structure** structure);

/* ---- Queries --------------------------------------------------------------------------------- */

/** How structures evaluate the points of a set. Does not change results. */
enum msq_query_method {
  /** Groups of points; groups with few points one at a time. */
  MSQ_QUERY_AUTO = 0,
  /** Each point by itself. */
  MSQ_QUERY_POINT = 1,
  /** Groups of nearby points, however small. */
  MSQ_QUERY_SET = 2
};

/** Options of a query. */
typedef struct msq_query_def {
  uint32_t struct_size;
  /** An msq_query_method, for msq_set_membership. Default MSQ_QUERY_AUTO. */
  int32_t method;
  /** Scales with a characteristic length of at least this are resolved; finer ones are solid. 0
   * (default): all. Infinity: the coarse shape only. */
  double length_scale;
  /** AUTO: minimum number of points in a group that is evaluated as a set. 0 (default): measured
   * for each kind of structure. */
  uint64_t critical_count;
  /** msq groups the points of an array by parts of a cell, this many along each axis, if the parts
   * hold hundreds of points. 1 (by cell) to 64, rounded down to a power of 2. 0 (default):
   * measured. Does not change results. */
  uint32_t group_parts;
  /** Must be 0. */
  uint32_t reserved;
} msq_query_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_query_def_init(msq_query_def* def, size_t size);

/** Kinds of point sets. */
enum msq_points_kind { MSQ_POINTS_ARRAY = 1, MSQ_POINTS_GRID = 2, MSQ_POINTS_STRATIFIED = 3 };

/** A set of points.
 *
 * ARRAY: count points in any order.
 * GRID: point (i, j, k) is origin + (i, j, k) * spacing and has index i + nx * (j + ny * k). With a
 * window, the set is the points of the window, and point window.first + (i, j, k) has index
 * i + window.count[0] * (j + window.count[1] * k).
 * STRATIFIED: per_cell uniformly random points in each cell of a box of nx * ny * nz cells. Cell
 * (i, j, k) has its corner at origin + rotation * ((i, j, k) * spacing) and its size is spacing.
 * Its point s has index s + per_cell * (i + nx * (j + ny * k)). Points are a function of their
 * index and the seed, equal on every machine, and are never stored. */
typedef struct msq_points_def {
  uint32_t struct_size;
  /** An msq_points_kind. No default. */
  int32_t kind;
  /** ARRAY: count triples x, y, z. No alignment is needed. */
  const void* coordinates;
  /** ARRAY. */
  uint64_t count;
  /** ARRAY: bytes from one point to the next. 0 (default): tightly packed. */
  uint64_t stride;
  /** ARRAY: MSQ_FLOAT32 or MSQ_FLOAT64 (default). */
  int32_t coordinate_type;
  /** Must be 0. */
  uint32_t reserved;
  /** GRID, STRATIFIED. */
  double origin[3];
  /** GRID, STRATIFIED. Positive. GRID: large enough that rounding keeps neighbours apart. */
  double spacing[3];
  /** GRID, STRATIFIED: nx, ny, nz, each 1 to 2^31 - 1; fewer than 2^63 points in total, or in the
   * window. */
  uint64_t counts[3];
  /** STRATIFIED: selects the sample. Default 0. */
  uint64_t seed;
  /** STRATIFIED: at least 1 (default). Standard errors need at least 2. */
  uint32_t per_cell;
  /** Must be 0. */
  uint32_t reserved2;
  /** STRATIFIED: as in msq_neighbourhood. Default identity. */
  double rotation[9];
  /** GRID: the points of the set. All zeros (default): the whole grid. */
  msq_window window;
} msq_points_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_points_def_init(msq_points_def* def, size_t size);

/** Writes points first to first + count - 1 of a set as count triples x, y, z: the exact numbers
 * that queries of the set use. Cost: about 5 ns per point, on the calling thread. Errors: ARGUMENT
 * (also past the end). Source: paper, section "Structured and Unstructured Set Queries"; Steele,
 * Lea and Flood 2014 (SplitMix64). */
MSQ_API msq_status msq_points_generate(const msq_points_def* points, uint64_t first, uint64_t count,
                                       double* coordinates);

/** Membership of one point: *inside receives 1 in the model or on its boundary, otherwise 0. query
 * NULL: defaults. For the boundary of meshes see msq_shape_from_mesh.
 *
 * This function is the definition. All other queries agree with it bit for bit. The one exception
 * is MSQ_FOAM_METHOD_2 with a jitter below 0.01, within 1e-9 of a cell of the boundary. Cost: a
 * mesh tests the triangles in one y, z bin; a lattice the struts that can reach the cell; a foam 27
 * to a few hundred seeds (about a microsecond). Errors: ARGUMENT, MEMORY. */
MSQ_API msq_status msq_point_membership(const msq_model* model, const double point[3],
                                        const msq_query_def* query, int32_t* inside);

/** Membership of a set: inside[i] receives 1 or 0 for point i. inside_count must be the number of
 * points. query NULL: defaults. job NULL: no job.
 *
 * Scales are evaluated from coarse to fine. A finer scale does not evaluate points that a coarser
 * one decided (msq_job_info counts them). ARGUMENT and LIMIT write nothing; CANCELLED and MEMORY
 * may leave inside partly written. Cost: arrays in parallel; foams group points by cell first, in
 * any order, with 0.2 MB per thread, and 6 bytes per point and at most 15 MB. The latter become
 * less, down to 0.1 MB, if the memory limit leaves no room. Grids cost far less per point, as
 * slices do. Stratified samples need no grouping and no memory.
 * Errors: ARGUMENT (also points that are not finite, with their index), CANCELLED, LIMIT, MEMORY.
 * Source: paper, section "Set-based queries". */
MSQ_API msq_status msq_set_membership(const msq_model* model, const msq_points_def* points,
                                      const msq_query_def* query, uint8_t* inside,
                                      uint64_t inside_count, msq_job* job);

/** Region of one point: *region receives the index of the first region whose shape contains it, -1
 * if none does. The point need not be in the solid of the region. A model that is not made of
 * regions is region 0. Regions of regions are counted in their order. Errors: ARGUMENT, MEMORY. */
MSQ_API msq_status msq_point_region(const msq_model* model, const double point[3], int32_t* region);

/** Regions of a set: regions[i] receives the result of msq_point_region for point i. region_count
 * must be the number of points. job NULL: no job. ARGUMENT and LIMIT write nothing; CANCELLED and
 * MEMORY may leave regions partly written. Cost: in parallel, the memberships in the shapes.
 * Errors: ARGUMENT (also points that are not finite, with their index), CANCELLED, LIMIT, MEMORY.
 */
MSQ_API msq_status msq_set_region(const msq_model* model, const msq_points_def* points,
                                  int32_t* regions, uint64_t region_count, msq_job* job);

/** Material of one point. *id receives the id of its material, or MSQ_MATERIAL_VOID outside the
 * model. values[c] receives the value of the channel named channels[c]; 0 outside, and where the
 * material has no such channel. query NULL: defaults. channels and values may be NULL if
 * channel_count is 0.
 *
 * The material is that of the finest resolved scale that has one, or of its skin inside the skin.
 * Where finer scales are not resolved, the host's material represents the mixture. Errors: ARGUMENT
 * (also if no resolved scale of the model, or of one of its regions, has a material, or none of
 * their materials has a channel of that name), MEMORY. Source: paper, section "Multiscale
 * Shape-Material Modeling API". */
MSQ_API msq_status msq_point_material(const msq_model* model, const double point[3],
                                      const msq_query_def* query, const char* const* channels,
                                      uint64_t channel_count, uint32_t* id, double* values);

/** Materials of a set: ids[i] and values[i * channel_count + c] receive, bit for bit, the result of
 * msq_point_material for point i. id_count must be the number of points, value_count channel_count
 * times that. query NULL: defaults. job NULL: no job. ARGUMENT and LIMIT write nothing; CANCELLED
 * and MEMORY may leave the arrays partly written. Cost: msq_set_membership plus a byte per point;
 * channels are evaluated at the points inside. Errors: ARGUMENT (also points that are not finite,
 * with their index), CANCELLED, LIMIT, MEMORY. Source: paper, section "Set-based queries". */
MSQ_API msq_status msq_set_material(const msq_model* model, const msq_points_def* points,
                                    const msq_query_def* query, const char* const* channels,
                                    uint64_t channel_count, uint32_t* ids, uint64_t id_count,
                                    double* values, uint64_t value_count, msq_job* job);

/** Signed distance of one point to the boundary of the model, in model units. *distance is
 * positive, at least 2.2e-308, where msq_point_membership returns 0, and at most 0 where it
 * returns 1. It is always finite. query NULL: defaults.
 *
 * The magnitude never exceeds the true distance, so a step of that length along a ray crosses no
 * surface. It is exact for primitives, clean meshes, and outside of lattices and foams with a
 * constant radius, and a lower bound otherwise. docs/accuracy.md tells, for each kind of shape and
 * structure, where the distance is exact and how tight the bound is. Outside the model the distance
 * is that of the coarsest scale that the point is outside of; inside, that of the nearest boundary
 * of any scale. For regions it is a bound, which ends where another region begins
 * (docs/accuracy.md).
 *
 * Cost: a mesh builds a tree of its triangles on first use (n log n; seconds for millions; about
 * 120 bytes per triangle until the shape is freed) and then visits about log n nodes. A lattice
 * evaluates the struts that can be nearest, a foam the edges of the seeds around the point
 * (microseconds). A functional structure takes about ten milliseconds on first use to bound its
 * slope. Errors: ARGUMENT, LIMIT (tree above the memory limit), MEMORY. Source: paper, section
 * "Multiscale Shape-Material Modeling API"; Hart, "Sphere tracing", 1996. */
MSQ_API msq_status msq_point_distance(const msq_model* model, const double point[3],
                                      const msq_query_def* query, double* distance);

/** Signed distances of a set: distance[i] receives, bit for bit, the result of msq_point_distance
 * for point i. distance_count must be the number of points. query NULL: defaults. job NULL: no job.
 * ARGUMENT and LIMIT write nothing; CANCELLED and MEMORY may leave distance partly written. Cost:
 * msq_point_distance in parallel, less for foams if points of a cell follow each other. Errors:
 * ARGUMENT (also points that are not finite, with their index), CANCELLED, LIMIT, MEMORY. Source:
 * paper, section "Set-based queries".
 */
MSQ_API msq_status msq_set_distance(const msq_model* model, const msq_points_def* points,
                                    const msq_query_def* query, double* distance,
                                    uint64_t distance_count, msq_job* job);

/** What msq_set_onset writes. */
enum msq_onset_value {
  /** The onset: the smallest radius, thickness or level at which the point is inside. Lattices and
   * foams: the distance to the nearest strut axis in model units; with strut factors, the minimum
   * of distance / factor. Plates and walls: the same with twice the distance to the nearest face.
   * Functional structures: the function; waves: the sum; sheets: the magnitude of these. Unions of
   * lattices of struts and foams of struts alone: the minimum of their onsets. */
  MSQ_ONSET_PLAIN = 0,
  /** The onset minus the structure's radius or level at the point: at most 0 inside, positive
   * outside. Unions: the minimum of these. */
  MSQ_ONSET_SIGNED = 1
};

/** Writes the onset of a structure, without a model, at each point of a set. value: an
 * msq_onset_value. onsets[i]: the onset of point i; infinity where it is not a number or is above a
 * limit. The limit is 4 times the smallest cell size for lattices and plates, over their greatest
 * factor; the smallest cell size for walls with holes; and the smallest limit of the members for
 * unions, where that of foams is the smallest cell size. Alone, foams without holes have no limit.
 * onset_count must be the number of points.
 *
 * gradients NULL: not wanted, and gradient_count is 0. Otherwise gradients[3 * i + axis] receives
 * the derivative along an axis of the model, and gradient_count is 3 * onset_count. It is a central
 * difference over 2^-17 of the smallest cell size on either side. Its error is about 1e-8 of the
 * largest slope where the function is smooth. Along ridges it is a mean of both sides. It is 0
 * where it is not finite.
 *
 * MSQ_ONSET_SIGNED agrees in sign with membership; for lattices and foams except within 1e-9 of a
 * cell of the boundary. job NULL: no job. ARGUMENT, LIMIT and UNSUPPORTED write nothing; CANCELLED,
 * HOST and MEMORY may leave the arrays partly written. Cost: in parallel, lattices and functions
 * about 0.1 us per point, foams 1.5 us, a wave 2 ns; seven times that with gradients; foams less if
 * points of a cell follow each other. Errors: ARGUMENT (also points that are not finite, with their
 * index), UNSUPPORTED (kinds without onset, as in msq_structure_calibrate), LIMIT (a point 2^24
 * cells from the origin of the grid), HOST (fields), CANCELLED, MEMORY. */
MSQ_API msq_status msq_set_onset(msq_context* context, const msq_structure* structure,
                                 const msq_points_def* points, int32_t value, double* onsets,
                                 uint64_t onset_count, double* gradients, uint64_t gradient_count,
                                 msq_job* job);

/** Writes the value of a field at each point of a set: values[i] is the number that msq uses at
 * point i. value_count must be the number of points. job NULL: no job. ARGUMENT writes nothing;
 * CANCELLED, HOST and MEMORY may leave values partly written. Cost: that of the field
 * (docs/concepts.md), in parallel. Errors: ARGUMENT (also points that are not finite, with their
 * index), HOST, CANCELLED, MEMORY. */
MSQ_API msq_status msq_field_evaluate(msq_context* context, const msq_field* field,
                                      const msq_points_def* points, double* values,
                                      uint64_t value_count, msq_job* job);

/* ---- Statistics ------------------------------------------------------------------------------ */

/* The functions of this section take a MSQ_POINTS_STRATIFIED sample with 2 to 4096 points per cell.
 * They measure in the box of the sample; only the far ends of segments may lie outside it. Outside
 * the coarse shape everything is void: to measure a structure by itself, use a model of it in all
 * space (msq_shape_all_space) or in a larger box. The error falls at least as 1 / sqrt(n) with the
 * number of points, faster with many small cells. It describes the sample, not the spread between
 * foams with other seeds. The same sample yields the same bits for any number of threads. Memory: a
 * few MB. Functions that take a model also fail with LIMIT where msq_set_membership or
 * msq_set_distance would. */

/** An estimate of a number between 0 and 1. */
typedef struct msq_estimate {
  double value;
  /** From the spread within the cells of the sample. */
  double standard_error;
  /** 95 % confidence interval (Wilson). */
  double low, high;
} msq_estimate;

/** What is measured. */
enum msq_phase { MSQ_PHASE_SOLID = 1, MSQ_PHASE_VOID = 2 };

/** Estimates the volume fraction of a phase (msq_phase) in the box of the sample. query NULL:
 * defaults. job NULL: no job. Cost: msq_set_membership. Errors: ARGUMENT, CANCELLED, MEMORY.
 * Source: paper, section "Set-based queries"; Cochran, "Sampling Techniques", 1977, chapter 5. */
MSQ_API msq_status msq_volume_fraction(const msq_model* model, const msq_points_def* sample,
                                       const msq_query_def* query, int32_t phase,
                                       msq_estimate* estimate, msq_job* job);

/** Segments for correlations. One segment of each length starts at each point of the sample. */
typedef struct msq_segments_def {
  uint32_t struct_size;
  /** An msq_phase. Default MSQ_PHASE_SOLID. */
  int32_t phase;
  /** Direction of all segments, of any length. 0 (default): each point has its own, uniform on the
   * sphere, a function of its index and the seed. */
  double direction[3];
  /** length_count lengths, finite, not negative, in any order. */
  const double* lengths;
  /** 1 to 4096. */
  uint64_t length_count;
  /** Step of msq_lineal_path in model units. 0 (default): 1/256 of the smallest characteristic
   * length that is resolved (msq_model_scale_length), or of the longest length if that is smaller.
   */
  double step;
} msq_segments_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_segments_def_init(msq_segments_def* def, size_t size);

/** Estimates the two-point correlation S2: estimates[i] receives the probability that both ends of
 * a segment of length i are in the phase. At length 0 this is the volume fraction. estimate_count
 * must be length_count. query NULL: defaults. job NULL: no job. Cost: msq_set_membership of the
 * sample, and again per length of those points that are in the phase. Errors: ARGUMENT, CANCELLED,
 * MEMORY. Source: Torquato, "Random Heterogeneous Materials", 2002, section 2.2. */
MSQ_API msq_status msq_two_point_correlation(const msq_model* model, const msq_points_def* sample,
                                             const msq_query_def* query,
                                             const msq_segments_def* def, msq_estimate* estimates,
                                             uint64_t estimate_count, msq_job* job);

/** Estimates the lineal-path function L: estimates[i] receives the probability that a segment of
 * length i lies entirely in the phase. Arguments as in msq_two_point_correlation.
 *
 * msq follows a segment by the steps that msq_point_distance allows, which cross no boundary, and
 * near boundaries by the step of def. Gaps shorter than that step may be missed; longer ones never
 * are. Ends are found within a thousandth of the step. Cost: tens of distances per point, and one
 * per step where the distance is 0. Errors: ARGUMENT, CANCELLED, LIMIT (a length above 10^6 steps),
 * MEMORY. Source: Torquato 2002, section 2.4; Lu and Torquato 1992. */
MSQ_API msq_status msq_lineal_path(const msq_model* model, const msq_points_def* sample,
                                   const msq_query_def* query, const msq_segments_def* def,
                                   msq_estimate* estimates, uint64_t estimate_count, msq_job* job);

/** Result of a calibration. */
typedef struct msq_calibration_report {
  uint32_t struct_size;
  uint32_t reserved;
  /** Points that were evaluated. */
  uint64_t samples;
  /** Smallest parameter at which at least the target fraction of the points is solid. */
  double parameter;
  /** Volume fraction at that parameter. */
  msq_estimate fraction;
  /** Volume fraction at the greatest parameter that the kind of structure allows. */
  double max_fraction;
} msq_calibration_report;

/** Finds the constant parameter (radius of struts, level of a function) at which a structure has a
 * target volume fraction, and the curve between the two. The parameter of the structure itself is
 * ignored.
 *
 * target: 0 to 1. parameters, fractions: receive pair_count pairs (2 to 2^20). At parameters[i] the
 * fraction is fractions[i] = i / (pair_count - 1) * max_fraction. Radii and thicknesses are in
 * model units. The fractions ascend strictly; neighbouring parameters may be equal. They convert a
 * field of density to one of radius (msq_field_map). parameters and fractions must be NULL if
 * pair_count is 0. report NULL: not wanted. sample NULL: 2 points in each of 64^3 parts of a box
 * that begins at the origin of the grid. The box is one cell for lattices and functional
 * structures, and 16^3 cells for foams and waves. With a period these are cells of the smallest
 * size; in unions they are those of the grid with the largest cells. Structures in warped cells
 * need a sample. job NULL: no job. Cost: the onset of each point (lattices 0.1 us, in warped cells
 * 10 to 100 us; foams 1.5 us; in parallel) and a sort; 16 bytes per point, accounted to the
 * context. Errors: ARGUMENT, UNSUPPORTED (kinds without onset: lattices with two or more unit
 * cells, lattices of plates and struts, foams of struts and walls, host structures and functions,
 * beams, and structures made of others, except unions of lattices of struts and foams of struts
 * alone), CANCELLED, LIMIT (target above max_fraction; points 2^24 cells or more from the origin of
 * a grid, or beyond 1e75; memory), MEMORY. */
MSQ_API msq_status msq_structure_calibrate(msq_context* context, const msq_structure* structure,
                                           const msq_points_def* sample, double target,
                                           double* parameters, double* fractions,
                                           uint64_t pair_count, msq_calibration_report* report,
                                           msq_job* job);

/* ---- Slicing --------------------------------------------------------------------------------- */

/** A model and a plan of layers. */
typedef struct msq_slicer msq_slicer;

/** Contents of a layer. Rows of pixels are padded with zeros to a multiple of 8 bytes. */
enum msq_layer_output {
  /** 1 bit per pixel, sampled at its centre. The leftmost pixel is the high bit, as in PNG and
   * PBM. */
  MSQ_LAYER_BITS = 1,
  /** 1 byte per pixel, sampled at its centre: 255 inside, 0 outside. */
  MSQ_LAYER_BYTES = 2,
  /** 1 byte per pixel: its coverage, from 0 to 255, by k x k samples with k = grey_samples. Sample
   * (a, b), 0 <= a, b < k, lies at the centre of the pixel + ((a, b) + 1/2) / k * pitch - pitch /
   * 2, the centre of its part of the pixel. With n samples inside the value is floor(255 * (n /
   * k^2)^grey_gamma + 1/2), or 0 if that is below grey_threshold. */
  MSQ_LAYER_GREY = 3,
  /** 1 float32 per pixel: the signed distance at its centre, as msq_set_distance returns it,
   * rounded to the nearest float32; outside at least 1.17549435e-38, so that the sign remains. Rows
   * have the byte order of the machine. */
  MSQ_LAYER_DISTANCE = 4,
  /** 1 uint32 per pixel: the id of the material at its centre, as msq_set_material returns it. A
   * resolved scale must have a material. */
  MSQ_LAYER_MATERIAL = 5,
  /** 1 float32 per pixel: the onset of a structure at its centre, as msq_set_onset returns it,
   * rounded to the nearest float32. The model must have one region. */
  MSQ_LAYER_ONSET = 6,
  /** No pixels: the rings that msq_slicer_contours returns. Only in msq_slicer_def.outputs. */
  MSQ_LAYER_CONTOURS = 7,
  /** 1 float32 per pixel: the value of a channel of the material at its centre, as msq_set_material
   * returns it, rounded to the nearest float32; 0 outside, and where the material has no such
   * channel. Only in msq_slicer_def.outputs. */
  MSQ_LAYER_CHANNEL = 8
};

/** How layers are mirrored and transposed for the panel of a printer before the host receives them.
 * A sum of the values below. Let the layer have W x H pixels, after exchanging the sides of the
 * plan if TRANSPOSE is set. Its pixel (i, j) is pixel (i', j') of the plan, where i' = W - 1 - i
 * with MIRROR_X and i otherwise, j' = H - 1 - j with MIRROR_Y and j otherwise, and TRANSPOSE
 * exchanges i' and j' at the end. */
enum msq_layer_orientation {
  MSQ_LAYER_MIRROR_X = 1,
  MSQ_LAYER_MIRROR_Y = 2,
  MSQ_LAYER_TRANSPOSE = 4
};

/** Rings of points: the section of a model with a plane. Immutable; any thread may read it. */
typedef struct msq_contours msq_contours;

/** Definition of contours. The plane is normal to an axis. Its coordinates u, v are the other two
 * axes in their order: x, y for axis z; x, z for axis y; y, z for axis x. */
typedef struct msq_contours_def {
  uint32_t struct_size;
  /** Type of the coordinates: MSQ_INT32, MSQ_INT64 or MSQ_FLOAT64 (default). */
  int32_t type;
  /** Normal of the plane: 0 (x), 1 (y) or 2 (z, default). */
  int32_t axis;
  /** 0 (default): the bounding box of the model; window_min and window_max must be 0. 1: the window
   * below. */
  int32_t has_window;
  /** Corners in u and v, in model units. Rings close along the edges of the window. Two windows
   * that have a whole edge in common, with the same other values of this struct, have the same
   * points on that edge, bit for bit. */
  double window_min[2];
  double window_max[2];
  /** Maximum distance between boundary and rings, in model units, where features are wider than
   * the pitch. Positive; there is no default. */
  double tolerance;
  /** Distance between the nodes at which the model is sampled. Rounded down to three binary digits.
   * Parts of the solid or of the void that contain a disc of diameter sqrt(2) * pitch are never
   * lost; narrower ones may be. If the tolerance is at most pitch / 8, a gap that becomes narrower
   * than the pitch is followed until it is about as narrow as the tolerance, or as pitch / 16 if
   * that is more (docs/concepts.md). 0 (default): the tolerance. Up to 2^18 times each side of the
   * window. */
  double pitch;
  /** Coordinates are model coordinates times this. Default 1. Integer coordinates are rounded to
   * the nearest integer. The pitch must then be at least 64 units, and the tolerance at least 4. */
  double units;
  /** As in msq_query_def. msq_slicer_contours takes that of the slicer, and this must be 0. */
  double length_scale;
  /** 0 (default): topology_count of the report is not computed. Otherwise 2, 4, 8 or 16: the rings
   * are compared with a mask of that many samples along each side of the grid's cells. This does
   * not change the rings. Costs about as much as the bits of that mask; memory: a band of its rows.
   */
  uint32_t topology_samples;
} msq_contours_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_contours_def_init(msq_contours_def* def, size_t size);

/** Definition of one of the outputs of a slicer. */
typedef struct msq_output_def {
  uint32_t struct_size;
  /** An msq_layer_output. Default MSQ_LAYER_BITS. */
  int32_t output;
  /** GREY: as in msq_slicer_def. Defaults 4, 0 and 1. */
  uint32_t grey_samples;
  uint32_t grey_threshold;
  double grey_gamma;
  /** ONSET: the scale of the structure, from 1. It must be resolved. 0 (default): the finest
   * resolved scale. */
  uint32_t onset_scale;
  /** ONSET: an msq_onset_value. Default MSQ_ONSET_PLAIN. */
  int32_t onset_value;
  /** CONTOURS: as msq_slicer_contours takes it. Copied. Other outputs: NULL (default). */
  const msq_contours_def* contours;
  /** CHANNEL: its name, in UTF-8, copied. A material of a resolved scale must have it. Other
   * outputs: NULL (default). */
  const char* channel;
} msq_output_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_output_def_init(msq_output_def* def, size_t size);

/** Definition of a slicer. */
typedef struct msq_slicer_def {
  uint32_t struct_size;
  /** An msq_layer_output except CONTOURS and CHANNEL. Default MSQ_LAYER_BITS. If outputs are given
   * it must be the default. */
  int32_t output;
  /** Pixel size in x and y. 0 (default): from region and resolution. */
  double pitch[2];
  /** Pixels in x and y. 0 (default): from region and pitch, rounded up. */
  uint32_t resolution[2];
  /** Positive, unless layer_z is given. */
  double layer_height;
  /** 0 (default): from region and layer_height, rounded up. */
  uint64_t layer_count;
  /** 0 (default): the region is the bounding box of the model, centred in the pixels; region_min
   * and region_max must be 0. 1: the region below. A model of all space needs 1. */
  int32_t has_region;
  /** Layers computed at once. 0 (default): about 64 layers in whole cells of the finest scale, at
   * least one. A slab takes at most 32 MiB and a quarter of the context's memory_limit. Some
   * structures do not become faster with more layers; their slabs take at most 2 MiB per thread. A
   * run computes fewer layers at once if the memory limit leaves less. The first slab of a run has
   * a 32nd of the layers, so that the host receives its first layer soon; slabs of at most 2 MiB
   * per thread are not divided in this way. If even one layer is too large, bands of its rows are
   * computed one after the other. Does not change results. */
  uint32_t slab_layers;
  /** Corner of pixel (0, 0) and bottom of layer 0. */
  double region_min[3];
  /** Required where a resolution or layer_count of 0 is computed from it. */
  double region_max[3];
  /** z of each layer, strictly ascending. NULL (default): the middle of each layer, region_min[2] +
   * (index + 1/2) * layer_height. */
  const double* layer_z;
  /** Number of layers in layer_z: 1 to 2^31 - 1. */
  uint64_t layer_z_count;
  /** As in msq_query_def. */
  double length_scale;
  /** Pixels and layers that are computed, as an index window of the plan that the fields above
   * make. The slicer then has window.count[2] layers of window.count[0] x window.count[1] pixels,
   * with their own indices from 0. All zeros (default): the whole plan. */
  msq_window window;
  /** GREY: samples along each side of a pixel: 2, 4 (default), 8 or 16. */
  uint32_t grey_samples;
  /** GREY: smaller values become 0 (minimum exposure). 0 (default) to 255. */
  uint32_t grey_threshold;
  /** GREY: 0.1 to 10. Default 1. */
  double grey_gamma;
  /** A sum of msq_layer_orientation. Default 0. It turns pixels. Contours keep the coordinates of
   * the model. */
  uint32_t orientation;
  /** Number of outputs: 1 to 64. 0 (default) if outputs is NULL. */
  uint32_t output_count;
  /** What each layer holds, in place of `output` and the values for GREY above. Copied. All
   * elements have the same struct_size, which is the distance between them. Outputs that sample the
   * same points share their samples: BITS and BYTES, and GREY of equal grey_samples. NULL
   * (default): one output, as above. */
  const msq_output_def* outputs;
  /** Where layers lie. The point with the coordinates u, v, w is frame_origin + u * axis 0 +
   * v * axis 1 + w * axis 2. Rows of pixels lie along u, one row follows the other along v, and
   * layers lie along w. x, y and z in the text above and of layers then mean u, v and w, also in
   * the region, in heights, in contours and in findings. Default 0. */
  double frame_origin[3];
  /** Three rows, the axes, orthonormal within 1e-9; msq takes the nearest axes that are
   * orthonormal. Left-handed axes mirror. All zeros (default): the axes of the model. For layers
   * normal to x whose pixels lie along y and z: {0, 1, 0, 0, 0, 1, 1, 0, 0}. Cost: bits of
   * layers normal to y with pixels along x and z cost what they do without a frame. Along other
   * axes they take 10 to 15 ns per sample and thread in a box; more in meshes and host shapes,
   * which evaluate points. */
  double frame_axes[9];
} msq_slicer_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_slicer_def_init(msq_slicer_def* def, size_t size);

/** Plans the layers of a model, normal to z or in a frame. Computes nothing yet. def must not be
 * NULL. Errors: ARGUMENT (also pixels or layers that rounding makes coincide, and a window outside
 * the plan), LIMIT (more than 2^31 - 1 layers, or pixels along a side, or 2^63 pixels in total or
 * in the window), UNSUPPORTED (ONSET of a model of several regions, or of a structure without
 * onset), MEMORY. */
MSQ_API msq_status msq_slicer_create(const msq_model* model, const msq_slicer_def* def,
                                     msq_slicer** slicer);
/** Adds a reference. */
MSQ_API void msq_slicer_retain(msq_slicer* slicer);
/** Drops a reference. */
MSQ_API void msq_slicer_release(msq_slicer* slicer);

/** The plan of a slicer. */
typedef struct msq_slicer_report {
  uint32_t struct_size;
  /** Layers computed at once, except in the first slab of a run. */
  uint32_t slab_layers;
  /** Pixels in x and y of the layers that the host receives: exchanged with TRANSPOSE. */
  uint32_t width, height;
  uint64_t layer_count;
  /** Bytes from one row to the next, a multiple of 8. Of the first output; CONTOURS: 0. */
  uint64_t stride;
  /** stride * height. */
  uint64_t layer_bytes;
  /** x, y of the centre of pixel (0, 0) of the whole plan. */
  double origin[2];
  /** Pixel (i, j) is sampled at origin + (i, j) * pitch, as in a grid of points. With a window:
   * at origin + (window.first + (i, j)) * pitch. */
  double pitch[2];
  /** The window. Without one: the whole plan. */
  msq_window window;
  /** Pixels in x and y, and layers, of the whole plan. */
  uint64_t whole[3];
} msq_slicer_report;

/** Reports the plan. Errors: ARGUMENT. */
MSQ_API msq_status msq_slicer_info(const msq_slicer* slicer, msq_slicer_report* report);

/** Returns z of the samples of a layer. Errors: ARGUMENT (index out of range). */
MSQ_API msq_status msq_slicer_layer_z(const msq_slicer* slicer, uint64_t index, double* z);

/** What one of the outputs is in a layer. Valid until the callback returns. */
typedef struct msq_output {
  /** Out: sizeof(msq_output) of the library. */
  uint32_t struct_size;
  /** An msq_layer_output. */
  int32_t output;
  /** height rows, row 0 at the smallest y. Bits past the width are 0. CONTOURS: NULL. */
  const uint8_t* data;
  /** Bytes from one row to the next. CONTOURS: 0. */
  uint64_t stride;
  /** Number of pixels inside. GREY: number of samples inside. ONSET, CONTOURS: 0. */
  uint64_t inside_count;
  /** CONTOURS: the rings of the layer, for msq_contours_info. To keep them beyond the callback,
   * retain them. Other outputs: NULL. */
  msq_contours* contours;
} msq_output;

/** One layer. Valid until the callback returns. */
typedef struct msq_layer {
  /** Out: sizeof(msq_layer) of the library. */
  uint32_t struct_size;
  /** The output, data, stride and inside_count below are those of the first output. */
  int32_t output;
  /** Number of the layer, from 0; with a window, from its first layer. */
  uint64_t index;
  double z;
  const uint8_t* data;
  uint64_t stride;
  /** Pixels of all outputs. */
  uint32_t width, height;
  uint64_t inside_count;
  /** At least 1. */
  uint64_t output_count;
  /** output_count pointers, in the order of msq_slicer_def.outputs. */
  const msq_output* const* outputs;
} msq_layer;

/** Receives a layer. Return 0 to continue, or the host's code, preferably negative, to stop.
 * Exceptions of the host's language must not leave it. */
typedef int32_t (*msq_layer_fn)(void* user, const msq_layer* layer);

/** Computes layers first to first + count - 1 and passes each to the callback, in ascending order,
 * on the calling thread. Workers compute the next slab meanwhile and wait for the callback. (With
 * the host's parallel_for, the next slab is computed after the callbacks of the slab.) count
 * UINT64_MAX: to the last layer. job NULL: no job. The bytes of a layer do not depend on how the
 * plan is split into calls or processes, nor on its other outputs. Memory, accounted to the
 * context: two slabs, one layer and a few tiles per thread, for any height of the stack. If two
 * slabs of one layer exceed memory_limit, a run takes one layer, two bands of its rows (at least 16
 * rows of samples each) and a few tiles per thread. If that exceeds the limit too, the run fails
 * with LIMIT: use windows. Foams also keep cells in the cache. Workers compute the contours of as
 * many layers at once as there are threads, and as many wait for the callback. If these exceed
 * memory_limit, contours are computed layer by layer. Errors: ARGUMENT, CANCELLED, HOST, LIMIT,
 * MEMORY; contours also those of msq_layer_contours, before their layer. Source: paper, section
 * "Slicing". */
MSQ_API msq_status msq_slicer_run(const msq_slicer* slicer, uint64_t first, uint64_t count,
                                  msq_layer_fn fn, void* user, msq_job* job);

/** Computes the first output of one layer, the same bytes as msq_slicer_run, into a buffer of at
 * least layer_bytes. A call that fails leaves the buffer untouched. For all outputs of one layer
 * call msq_slicer_run with a count of 1. Cost: about that of msq_slicer_run for a layer that
 * follows one which any thread requested recently. Such layers are computed together, by all
 * threads that request them. Other layers cost up to three times as much. Memory: the bits of one
 * layer and a few tiles per thread; if these exceed memory_limit, one layer and a band of its rows.
 * Layers that are computed ahead take at most two slabs, until the slicer is freed or a call needs
 * the memory.
 * Errors: ARGUMENT (also if the first output is contours), CANCELLED, LIMIT, MEMORY. */
MSQ_API msq_status msq_slice_layer(const msq_slicer* slicer, uint64_t index, uint8_t* buffer,
                                   uint64_t buffer_bytes, msq_job* job);

/* ---- Contours -------------------------------------------------------------------------------- */

/** Computes the contours of the section of a model at a height along the axis.
 *
 * Rings are closed and simple, and no two of them meet. The inside is on the left: outer rings are
 * counter-clockwise in (u, v), holes clockwise. Corners are points of the rings. Points that the
 * tolerance does not need are left out. Rings come in the order of the lowest rows of nodes that
 * they reach, so a ring's parent has a smaller index. The same arguments yield the same bytes, on
 * any thread.
 *
 * contours: a new handle. job NULL: no job. Any number of threads may call it at once. Memory: in
 * proportion to the window's nodes and crossings, accounted to the context while the call lasts.
 * The result is not accounted. Errors: ARGUMENT, CANCELLED, HOST, LIMIT (2^31 nodes along an axis;
 * 2^32 crossings; coordinates beyond the type, for int64 beyond 2^53; memory), MEMORY. Source:
 * marching squares; Imai and Iri 1986. */
MSQ_API msq_status msq_layer_contours(const msq_model* model, double height,
                                      const msq_contours_def* def, msq_contours** contours,
                                      msq_job* job);

/** Computes the contours of a layer of a slicer, at the layer's z and with the slicer's
 * length_scale. axis must be 2. has_window 0: the rectangle of the slicer's pixels. Errors: as
 * msq_layer_contours; ARGUMENT also for an index out of range. */
MSQ_API msq_status msq_slicer_contours(const msq_slicer* slicer, uint64_t index,
                                       const msq_contours_def* def, msq_contours** contours,
                                       msq_job* job);
/** Adds a reference. */
MSQ_API void msq_contours_retain(msq_contours* contours);
/** Drops a reference. */
MSQ_API void msq_contours_release(msq_contours* contours);

/** The rings of contours. Pointers are valid as long as the contours are. */
typedef struct msq_contours_report {
  uint32_t struct_size;
  /** As in the definition. */
  int32_t type;
  uint64_t ring_count;
  /** Of all rings together. A ring does not repeat its first point. */
  uint64_t point_count;
  /** Pairs u, v of the type. */
  const void* points;
  /** ring_count + 1 numbers: points starts[i] to starts[i + 1] - 1 are those of ring i. */
  const uint64_t* starts;
  /** The ring just around ring i. -1: none. The parent of a hole is an outer ring; that of an outer
   * ring is a hole. */
  const int64_t* parents;
  /** 1: a hole. 0: an outer ring. */
  const uint8_t* holes;
  /** Places where the rings may be wrong at the scale of the pitch: where one sample decided what
   * is connected, where the boundary is not within the tolerance, and cells that a strut crosses
   * without covering a node. Other features that no node or crossing meets are not counted. */
  uint64_t unresolved_count;
  /** Distance between the nodes, as rounded. */
  double pitch;
  /** With topology_samples: an upper bound on the number of parts that must appear, vanish, be cut
   * or be joined until the rings have the topology of a mask with topology_samples samples per
   * pitch. The numbers of outer rings and of parts of the mask differ by no more, nor do those of
   * holes and of enclosed parts of the void. 0: both have the same topology.
   * Features that the mask does not show are not counted. 0 without topology_samples. */
  uint64_t topology_count;
  /** As in the definition. */
  uint32_t topology_samples;
} msq_contours_report;

/** Reports the rings of contours. Errors: ARGUMENT. */
MSQ_API msq_status msq_contours_info(const msq_contours* contours, msq_contours_report* report);

/* ---- Printability ---------------------------------------------------------------------------- */

/** Possible problems in printing layers. docs/concepts.md defines the kinds exactly. */
enum msq_finding_kind {
  /** A part of a layer, connected in the layer, that lies on no solid sample of the layer below. */
  MSQ_FINDING_ISLAND = 1,
  /** A connected part of the solid that does not reach the plate. Without a plate: any part except
   * the one with the most samples. */
  MSQ_FINDING_LOOSE = 2,
  /** An enclosed void, which traps resin or powder: connected empty samples that reach neither a
   * side of the grid nor its top; without a plate, nor its bottom. One that begins in layer 0 is
   * open at the plate only. */
  MSQ_FINDING_VOID = 4,
  /** Connected samples where the solid is thinner in its layer than a given width. */
  MSQ_FINDING_THIN = 8,
  /** A cup: a void that is closed except where the next layer is printed, so it sucks at the film
   * of a resin printer. In other words: empty samples that are connected within layers 0 to k,
   * reach layer k, and reach neither a side of the grid nor, without a plate, its bottom. Each cup
   * is listed once, for the last such k, which is its last_layer. Voids that close are listed as
   * VOID only. */
  MSQ_FINDING_CUP = 16,
  /** Connected samples of a layer with none below them, and none in the layer below within a given
   * horizontal distance. */
  MSQ_FINDING_OVERHANG = 32
};

/** Selects findings. */
typedef struct msq_printability_def {
  uint32_t struct_size;
  /** A sum of msq_finding_kind. Default ISLAND + LOOSE + VOID. */
  uint32_t kinds;
  /** 1 (default): the first layer lies on a build plate, which carries it and closes voids. 0:
   * there is nothing below. */
  int32_t has_plate;
  /** Must be 0. */
  uint32_t reserved;
  /** THIN: the width in model units, 2 to 32 pixels along x and y. Otherwise 0 (default). */
  double width;
  /** Findings of less volume are ignored. In model units cubed, at least 0. Default 0. */
  double min_volume;
  /** OVERHANG: the distance in model units, 0 (default) to 31 pixels along x and y. Solid that
   * leans by an angle reaches layer_height * tan(angle) beyond the layer below. Otherwise 0. */
  double overhang;
} msq_printability_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_printability_def_init(msq_printability_def* def, size_t size);

/** A possible problem in printing. A sample represents the box of a pixel and its layer's height,
 * which reaches half-way to the layers around it. */
typedef struct msq_finding {
  /** An msq_finding_kind. */
  int32_t kind;
  uint32_t reserved;
  /** Layers of the slicer, the first and the last one that it has samples in. */
  uint64_t first_layer;
  uint64_t last_layer;
  uint64_t sample_count;
  /** In model units cubed. Of an island: in its layer. */
  double volume;
  /** One of its samples, in model units: of its first layer, at the lowest y and there at the
   * lowest x. */
  double point[3];
  /** Box around its samples, in model units. */
  double min[3], max[3];
} msq_finding;

/** Receives findings, at most 4096 at a time, valid until it returns. Return 0 to continue, or the
 * host's code, preferably negative, to stop. Exceptions of the host's language must not leave it.
 */
typedef int32_t (*msq_findings_fn)(void* user, const msq_finding* findings, uint64_t count);

/** Totals of what was found. Volumes are in model units cubed. */
typedef struct msq_printability_report {
  uint32_t struct_size;
  uint32_t reserved;
  /** Layers that were inspected. */
  uint64_t layer_count;
  /** Solid samples, and their volume. */
  uint64_t solid_count;
  double solid_volume;
  /** Findings of each kind. 0 for kinds that were not looked for. */
  uint64_t island_count, loose_count, void_count, thin_count;
  double island_volume, loose_volume, void_volume, thin_volume;
  uint64_t cup_count, overhang_count;
  double cup_volume, overhang_volume;
} msq_printability_report;

/** Finds possible problems in printing a slicer's layers: islands, loose parts, enclosed voids,
 * thin places, cups, overhangs.
 *
 * It inspects all layers of the slicer, one sample per pixel at its centre; output and orientation
 * of the slicer are ignored. Features smaller than a pixel may lie between samples: to find them,
 * use a slicer with a finer pitch. Solid samples of a layer are connected across sides and corners,
 * empty ones across sides; samples of two layers are connected if one is on the other.
 *
 * def NULL: defaults. fn NULL: no list. Otherwise fn is called on the calling thread with each
 * finding once, after the layer that ends it, in an order that depends on the layers alone. Results
 * do not depend on threads and slabs. job NULL: no job. Memory: that of msq_slicer_run, up to 22
 * bits per pixel of a layer, and runs and totals of parts outside of the main body, for any
 * height of the stack. Runs and totals are accounted to the context after each layer. Workers share
 * the rows of each layer. Cost: 1.2 to 1.4 times that of msq_slicer_run for bits of foams of struts
 * and of turned lattices, 1.7 to 2.5 times for lattices and functions along the grid, whose bits
 * cost little, and for thousands of enclosed voids in a layer. Where rows repeat, bits are copies,
 * and the cost is up to 0.2 ns per sample more than theirs. THIN, CUP and OVERHANG add to that: see
 * docs/benchmarks.md. Errors: ARGUMENT, CANCELLED, HOST, LIMIT (memory; 2^32 - 1 runs in a layer),
 * MEMORY. Source: Hoshen and Kopelman, "Percolation and cluster distribution", 1976. */
MSQ_API msq_status msq_printability(const msq_slicer* slicer, const msq_printability_def* def,
                                    msq_findings_fn fn, void* user, msq_printability_report* report,
                                    msq_job* job);

/* ---- Fill lines ------------------------------------------------------------------------------ */

/** Lines that fill a polygon: paths for a nozzle that prints thin walls as single lines. */
typedef struct msq_fill msq_fill;

/** A ring of a polygon. */
typedef struct msq_ring {
  /** count pairs x, y of the definition's coordinate_type. The last point is joined to the first.
   * No alignment is needed. */
  const void* points;
  /** At least 3. */
  uint64_t count;
} msq_ring;

/** A polygon with holes at a height, and how it is filled. */
typedef struct msq_fill_def {
  uint32_t struct_size;
  /** Type of the coordinates of the rings and of the result: MSQ_INT32 or MSQ_INT64 (default). */
  int32_t coordinate_type;
  /** ring_count rings, outlines and holes in any order and direction. Points enclosed by an odd
   * number of rings are filled. */
  const msq_ring* rings;
  uint64_t ring_count;
  /** Bytes from one point of a ring to the next. 0 (default): tightly packed. */
  uint64_t point_stride;
  /** Model units per unit of the coordinates, for example 1e-6 for nanometres in a model in
   * millimetres. No default. */
  double scale;
  /** x, y in the model of the coordinates 0, 0. Default 0. */
  double origin[2];
  /** In model units. Slicers take the middle of the layer. Default 0. */
  double z;
  /** Maximum distance between the lines and the middle of the walls, in model units, before
   * rounding to the coordinates. Less than half a unit of the coordinates gains nothing. 0
   * (default): 1/200 of the smallest cell size. */
  double tolerance;
  /** In model units. Shorter paths are dropped. Shorter lines between two points where an odd
   * number of lines meet are dropped too: each saves a path. If min_length is at most the width of
   * a printed line, the lines that continue at the two ends still touch. Default 0. */
  double min_length;
  /** Distance between two lines side by side, in model units, about the width of a line. 0
   * (default): no wall is printed twice. If it is positive, some walls between points where an odd
   * number of lines meet become two lines side by side. This joins paths, so a printer stops less
   * often and travels less. Such walls are 15 to 25 % of the length of a foam's lines, which grows
   * by as much; msq_fill_calibrate counts each wall once. Shorter walls are chosen first. A wall is
   * not chosen if one of its two lines would leave the polygon. The two lines may cross. */
  double pair_distance;
  /** In model units, about the width of a line. If positive, corners of paths are rounded, so that
   * a printer need not slow down as much for them: a parabola of four lines replaces each corner.
   * It begins and ends at most at this distance from the corner, and at most half way to the next
   * point. So no line moves by more than half of this distance, beyond the tolerance. Bends of up
   * to 11 degrees stay, and so do corners whose curve would leave the polygon. The lines of a foam
   * become a few percent shorter, which msq_fill_calibrate does not count. Default 0: no corner is
   * rounded. */
  double corner_distance;
} msq_fill_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_fill_def_init(msq_fill_def* def, size_t size);

/** Computes the middle lines of a structure's thin walls at a height, within a polygon.
 *
 * The lines are the section of the plane at z with these surfaces: the faces of a foam's diagram,
 * without the holes of vent_radius; the plates of a plate lattice; for a sheet, the surface where
 * the function, or the sum of waves, is 0; for a network, the surface where it equals the level. A
 * union has the lines of all members. An intersection has the lines of its first member that are
 * inside all others. A difference has the lines of its first member that are outside of all others.
 * Radius, level of sheets and thickness are ignored. Lattices of struts, beams, blends and
 * structures of msq_structure_host have no such lines; use contours for them.
 *
 * Each line is in one path. No line is printed twice unless pair_distance is set. The number of
 * paths is the minimum: half the number of points where a path must end. These are the points at
 * the border and the junctions of three, five, ... lines. At a junction, the lines that are most
 * nearly straight are joined, unless this adds paths. Paths come in printing order: each begins
 * near the end of the one before. The travel between connected lines is a few percent above the
 * minimum. Lines of a function that cross, as at the heights where a Schwarz P surface has straight
 * ones, may touch there without a junction: the function's samples tell two lines apart that turn.
 *
 * Ends of lines at the polygon's border are rounded to whole coordinates. All other decisions are
 * exact. Lines on the border itself count as inside on one side of the polygon. Where polygons of a
 * layer touch, lines go on from one to the other: those of foams at the same point, those of plates
 * within a few units, those of functions and waves, which are simplified from each polygon's border
 * on, within twice the tolerance.
 * Functions are sampled on a grid of 1/32 of the smallest cell size, waves on one of 1/16
 * (docs/concepts.md has the grid of warped cells). Lines closer together than that may be joined,
 * and smaller closed lines lost.
 *
 * def must not be NULL. job NULL: no job. Limits: coordinates up to 2^53 in magnitude; 2^24 cells
 * from the origin of the grid; about 2^26 seeds or 2^26 squares along a side of the polygon's box.
 * Cost: on the calling thread; many threads may call at once. About 20 us per cell of a foam or of
 * plates; 1 us per square that a function's line crosses, 20 ns per other square; of waves 11 ns
 * per wave and square that a line crosses. Errors: ARGUMENT (also, with its index: a ring of fewer
 * than 3 points or whose points are on one line; a pair_distance or corner_distance above 2^54
 * units), UNSUPPORTED (no thin walls), LIMIT, CANCELLED, HOST, MEMORY. Source: Aurenhammer, "Power
 * diagrams", 1987; Lorensen and Cline, "Marching cubes", 1987; Edmonds and Johnson, "Matching,
 * Euler tours and the Chinese postman", 1973. */
MSQ_API msq_status msq_fill_lines(msq_context* context, const msq_structure* structure,
                                  const msq_fill_def* def, msq_fill** fill, msq_job* job);
/** Adds a reference. */
MSQ_API void msq_fill_retain(msq_fill* fill);
/** Drops a reference. */
MSQ_API void msq_fill_release(msq_fill* fill);

/** The paths of a fill. The arrays belong to the fill and are valid as long as it is. */
typedef struct msq_fill_report {
  uint32_t struct_size;
  /** As in the definition. */
  int32_t coordinate_type;
  /** point_count pairs x, y of int32_t or int64_t. */
  const void* points;
  uint64_t point_count;
  /** path_count + 1 numbers: path i has the points path_starts[i] to path_starts[i + 1] - 1. */
  const uint64_t* path_starts;
  /** path_count bytes. 1: the last point is joined to the first; 0: it is not. */
  const uint8_t* closed;
  uint64_t path_count;
  /** Length of all paths in model units. */
  double length;
  /** Length of the straight moves from each path to the next, in model units. */
  double travel;
} msq_fill_report;

/** Reports the paths. Errors: ARGUMENT. */
MSQ_API msq_status msq_fill_info(const msq_fill* fill, msq_fill_report* report);

/** Finds the cell sizes at which a structure's fill lines cover a given share of the area.
 *
 * line_width: in model units, positive. density: this share, above 0 and at most 1. It is the
 * length of the lines per area, times line_width, on average over all heights. It is inversely
 * proportional to the cell size. cell_size receives the cell sizes of the structure's grid, all
 * multiplied by the same factor. Create the structure anew with these and the same rotation.
 * Multiply weight and vent_radius of a foam by the same factor. job NULL: no job.
 *
 * Single layers differ from the average, those of a gyroid by a tenth. msq measures the lines of
 * the structure as it is defined: one cell at 64 heights, or 8 x 8 cells at 61 or 64 heights if the
 * grid is rotated, or 32 x 32 cells of foams and waves at 32 heights. It is accurate to about
 * 0.5 %. Calibrate a foam without its field of density: d seeds per cell volume multiply the
 * density of lines by about the cube root of d.
 *
 * Cost: up to 0.5 s for a foam, 0.8 s and 0.017 s per wave for waves. Errors: ARGUMENT, UNSUPPORTED
 * (a structure without thin walls; a structure whose lines are denser in some places, by a period,
 * a warp, or a field of density, vent_radius or the level of a network; a structure made of other
 * structures), LIMIT (a structure without lines; cells that would be below 1e-75 or above 1e75),
 * CANCELLED, HOST, MEMORY. */
MSQ_API msq_status msq_fill_calibrate(msq_context* context, const msq_structure* structure,
                                      double line_width, double density, double cell_size[3],
                                      msq_job* job);

/* ---- Preview meshes ---------------------------------------------------------------------------
 */

/** Definition of a mesh. */
typedef struct msq_surface_def {
  uint32_t struct_size;
  /** 0 (default): the bounding box of the model; min and max must be 0. 1: the box below. A model
   * of all space needs 1. */
  int32_t has_box;
  /** Corners of the box, in model units. The mesh is closed where its faces cut the model. */
  double min[3];
  double max[3];
  /** Distance between the nodes at which the model is sampled, in model units. Positive; there is
   * no default. Walls and struts narrower than sqrt(3) * pitch may break or be lost. */
  double pitch;
  /** As in msq_query_def. */
  double length_scale;
  /** Layers of nodes per callback, at most. 0 (default): as many as fit 32 MiB of nodes and about
   * 2^18 crossings. Does not change the mesh. */
  uint32_t slab_layers;
  /** Must be 0. */
  uint32_t reserved;
} msq_surface_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_surface_def_init(msq_surface_def* def, size_t size);

/** A part of a mesh. The arrays are valid until the callback returns. The parts in sequence are the
 * mesh. */
typedef struct msq_surface_slab {
  /** Out: sizeof(msq_surface_slab) of the library. */
  uint32_t struct_size;
  uint32_t reserved;
  /** Number of vertices in the parts before this one. */
  uint64_t first_vertex;
  uint64_t vertex_count;
  /** vertex_count triples x, y, z. */
  const double* vertices;
  /** vertex_count triples: outward, of length 1. The normal of the surface at the vertex, as in
   * msq_ray_hit; on an edge, that of one of its sides or their mean. */
  const float* normals;
  /** Number of triangles in the parts before this one. */
  uint64_t first_triangle;
  uint64_t triangle_count;
  /** triangle_count triples of vertices, counter-clockwise seen from outside. Vertices are numbered
   * through the whole mesh: a triangle has vertices of this part or of parts before it. */
  const uint32_t* triangles;
} msq_surface_slab;

/** Receives a part of a mesh. Return 0 to continue, or the host's code, preferably negative, to
 * stop. Exceptions of the host's language must not leave it. */
typedef int32_t (*msq_surface_fn)(void* user, const msq_surface_slab* slab);

/** Computes triangles of the boundary of a model within a box, for display and for programs that
 * take only meshes. Layers, contours, rays and distances do not need a mesh: msq computes them from
 * the model itself, faster and exactly.
 *
 * The mesh is closed, and a manifold: each edge has two triangles, which run through it in opposite
 * directions, and the triangles around a vertex are one ring. Each vertex is within pitch / 1000 of
 * the boundary of the model cut with the box. Edges and corners of the model that are wider apart
 * than the pitch are kept. Triangles may intersect where the boundary is bent within a pitch.
 *
 * Callbacks run on the calling thread, from low z to high z. The parts together do not depend on
 * slab_layers, threads or calls. If no node is inside the model, the callback is not called. def
 * must not be NULL. job NULL: no job. Cost: parallel; two rays per vertex and one sample per node.
 * Memory: about 200 bytes per vertex of a part, and the nodes of a slab, accounted to the context.
 * Errors: ARGUMENT (also a pitch that is too small for the coordinates), CANCELLED, HOST, LIMIT
 * (2^31 nodes along an axis; 2^32 vertices; memory), MEMORY. Source: Schaefer, Ju and Warren,
 * "Manifold dual contouring", 2007. */
MSQ_API msq_status msq_surface_mesh(const msq_model* model, const msq_surface_def* def,
                                    msq_surface_fn fn, void* user, msq_job* job);

/** Formats of mesh files. */
enum msq_surface_format {
  /** Binary STL: triangles without common vertices, coordinates as float32. */
  MSQ_SURFACE_STL = 1,
  /** Binary PLY, low bytes first: vertices with normals, as float32, and triangles. */
  MSQ_SURFACE_PLY = 2
};

/** Some bytes of a file. Valid until the callback returns. */
typedef struct msq_file_part {
  /** Out: sizeof(msq_file_part) of the library. */
  uint32_t struct_size;
  uint32_t reserved;
  /** Where the bytes belong in the file. */
  uint64_t offset;
  /** Number of bytes, at least 1. */
  uint64_t size;
  /** Size of the whole file, the same in all parts. */
  uint64_t total;
  const uint8_t* bytes;
} msq_file_part;

/** Receives some bytes of a file. Return 0 to continue, or the host's code, preferably negative, to
 * stop. Exceptions of the host's language must not leave it. */
typedef int32_t (*msq_file_fn)(void* user, const msq_file_part* part);

/** Computes the mesh of msq_surface_mesh as the bytes of a file. format: an msq_surface_format.
 *
 * Each byte of the file is in one part. Parts of MSQ_SURFACE_STL come in the order of the file. In
 * MSQ_SURFACE_PLY vertices come before triangles, so its parts alternate between two places: seek
 * to offset, or copy to it in memory of total bytes. The bytes of the file do not depend on
 * slab_layers or threads. Coordinates are rounded to float32: far from the origin, vertices closer
 * together than that may coincide.
 *
 * Cost: as msq_surface_mesh, and the samples once more, to count triangles before the first is
 * written. If no node is inside the model, the file has no triangles. Errors: as
 * msq_surface_mesh; LIMIT also for 2^32 triangles or 2^31 vertices. */
MSQ_API msq_status msq_surface_file(const msq_model* model, const msq_surface_def* def,
                                    int32_t format, msq_file_fn fn, void* user, msq_job* job);

/* ---- Rays ------------------------------------------------------------------------------------ */

/** An array of rays: origin + t * direction. */
typedef struct msq_rays_def {
  uint32_t struct_size;
  /** Of origins and directions: MSQ_FLOAT32 or MSQ_FLOAT64 (default). */
  int32_t coordinate_type;
  uint64_t count;
  /** count triples x, y, z. */
  const void* origins;
  /** count triples, of any length except 0. */
  const void* directions;
  /** Bytes from one origin to the next. 0 (default): tightly packed. */
  uint64_t origin_stride;
  /** Bytes from one direction to the next. 0 (default): tightly packed. */
  uint64_t direction_stride;
  /** count numbers. NULL (default): 0. */
  const double* t_min;
  /** count numbers, may be infinity. NULL (default): infinity. A model of all space needs finite
   * ones. */
  const double* t_max;
} msq_rays_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_rays_def_init(msq_rays_def* def, size_t size);

/** Where a ray first meets the solid. */
typedef struct msq_ray_hit {
  /** The point is origin + t * direction. Infinity: no hit. */
  double t;
  /** Outward, of length 1. Against the ray if it starts inside. 0 without a hit. */
  double normal[3];
  /** Scale whose surface was hit; 0: the coarse shape; -1: no hit. */
  int32_t scale;
  /** 1: the ray is inside at t_min; t is t_min and scale is the finest one. */
  int32_t starts_inside;
  /** Cell of the finest resolved structure at the point; 0 for beams, which have no cells. */
  int32_t cell[3];
  /** Material id just inside. MSQ_MATERIAL_VOID without a hit, or if no resolved scale has a
   * material. */
  uint32_t material;
} msq_ray_hit;

/** Finds where each ray first meets the solid at t_min <= t <= t_max. hits[i] belongs to ray i.
 * hit_count must be the number of rays. query NULL: defaults. job NULL: no job. A solid that begins
 * at t_max is hit if the rounded point there is inside.
 *
 * Membership (msq_point_membership) changes within a tolerance of t. The tolerance is 2^-36 of the
 * characteristic length of the scale that was hit, or 2^-50 of the largest coordinate of the ray in
 * the shape's box, relative to the origin and to that of the grid, if that is more. Before t
 * membership does not change, except over parts of the ray shorter than the tolerance. Exceptions:
 * shapes and structures that are defined by callbacks, by images, or by fields without a Lipschitz
 * constant. docs/accuracy.md lists the tolerance of position and normal for each kind. Points of a
 * ray are accurate to 2^-53 of the distance from its origin. The search ends for every ray. t is
 * finite in each hit. Results do not depend on the order of the rays.
 *
 * Finer scales are evaluated only where the ray is inside the coarser ones. ARGUMENT and LIMIT
 * write nothing; CANCELLED and MEMORY may leave hits partly written. Cost: parallel. Rays that are
 * close together share work; rays in random order are sorted first, up to 2^20 at once, with 16
 * bytes each and at most 1/16 of the memory limit. A mesh builds its tree first, as for
 * msq_point_distance. Errors: ARGUMENT (also rays that are not finite and directions of length 0,
 * with their index), CANCELLED, LIMIT, MEMORY. Source: paper, section "Set Queries for
 * Ray-Casting". */
MSQ_API msq_status msq_ray_cast(const msq_model* model, const msq_rays_def* rays,
                                const msq_query_def* query, msq_ray_hit* hits, uint64_t hit_count,
                                msq_job* job);

/* ---- Cameras and pictures -------------------------------------------------------------------- */

/** How the rays of a camera run: parallel, or from the eye. */
enum msq_projection { MSQ_CAMERA_ORTHOGRAPHIC = 0, MSQ_CAMERA_PERSPECTIVE = 1 };

/** A camera. It looks from eye to target, which is the middle of the picture. Depth is the distance
 * from the plane through eye normal to that direction. docs/concepts.md has the formulas. */
typedef struct msq_camera {
  uint32_t struct_size;
  /** An msq_projection. Default MSQ_CAMERA_ORTHOGRAPHIC. */
  int32_t projection;
  /** PERSPECTIVE: origin of all rays. ORTHOGRAPHIC: a point of the plane of their origins. No
   * default. */
  double eye[3];
  /** Different from eye. No default. */
  double target[3];
  /** Upwards in the picture. Not parallel to the view. Default 0, 0, 1. */
  double up[3];
  /** ORTHOGRAPHIC: height of the picture in model units. No default. */
  double height;
  /** PERSPECTIVE: vertical angle of view in degrees, 0.001 to 179. Default 40. */
  double field_of_view;
  /** Depths between which the model is visible; the rest is cut away. 0 <= near < far. Defaults 0
   * and infinity. */
  double clip_near, clip_far;
} msq_camera;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_camera_init(msq_camera* camera, size_t size);

/** Sets eye, target, up and height so that the bounding box of the model fits a picture of width x
 * height pixels (1 to 16384 each). direction: from eye to target, of any length except 0. up NULL:
 * z, or y if z is within 2.6 degrees of the view. Other fields keep their values; a perspective
 * camera uses field_of_view. Errors: ARGUMENT. */
MSQ_API msq_status msq_camera_fit(const msq_model* model, const double direction[3],
                                  const double up[3], uint32_t width, uint32_t height,
                                  msq_camera* camera);

/** Returns the ray of a position in a picture of width x height pixels. position: pixels to the
 * right of and below the upper left corner; the centre of pixel (i, j) is (i + 0.5, j + 0.5). With
 * the returned direction the t of msq_ray_cast is the depth, and a ray from t_min = clip_near to
 * t_max = clip_far hits exactly what msq_render draws. Use it for picking, and for pictures that
 * the host renders itself. Errors: ARGUMENT. */
MSQ_API msq_status msq_camera_ray(const msq_camera* camera, uint32_t width, uint32_t height,
                                  const double position[2], double origin[3], double direction[3]);

/** Base colour of a surface. */
enum msq_colour_by {
  /** colours[0] */
  MSQ_COLOUR_PLAIN = 0,
  /** colours[scale % colour_count] */
  MSQ_COLOUR_SCALE = 1,
  /** colours[material id % colour_count] */
  MSQ_COLOUR_MATERIAL = 2,
  /** red, green, blue = (1 + normal) / 2 */
  MSQ_COLOUR_NORMAL = 3
};

/** How a picture is rendered. */
typedef struct msq_render_def {
  uint32_t struct_size;
  /** Size of the whole picture in pixels, 1 to 16384. No default. */
  uint32_t width, height;
  /** Upper left corner of the tile to render. */
  uint32_t tile_x, tile_y;
  /** Size of the tile. All four 0 (default): the whole picture. A tile has exactly the pixels of
   * the whole picture. */
  uint32_t tile_width, tile_height;
  /** rgba: samples along each side of a pixel, 1 (default) to 16. */
  uint32_t samples;
  /** With a callback: 2, 4, ... 64: the first pass casts one ray per square block with this side in
   * pixels; each further pass halves the side. 1 (default): one pass. */
  uint32_t first_step;
  /** An msq_colour_by. */
  int32_t colour_by;
  /** colour_count triples red, green, blue, linear, 0 to 1. NULL (default): 8 colours of msq. */
  const double* colours;
  /** 1 to 65536. */
  uint64_t colour_count;
  /** Red, green, blue (linear) and opacity where nothing is hit. Default 0. */
  double background[4];
  /** Direction to the light in the frame of the camera: right, up, towards the eye. Any length
   * except 0. Default -0.4, 0.6, 1. */
  double light[3];
  /** Share of ambient light, 0 to 1. Default 0.3. */
  double ambient;
  /** 1: a shadow ray per lit sample. Default 0. */
  int32_t shadows;
  /** Ambient occlusion rays per sample, 0 (default) to 256, distributed by the cosine with the
   * normal. */
  uint32_t occlusion_rays;
  /** Length of occlusion rays in model units. 0 (default): a tenth of the diagonal of the bounding
   * box. */
  double occlusion_distance;
} msq_render_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_render_def_init(msq_render_def* def, size_t size);

/** Arrays that receive pixels. Pixel (i, j) of the tile, j downwards, has index j * row_pixels + i.
 * Arrays that are NULL are skipped. All arrays except rgba describe the ray through the centre of
 * the pixel. */
typedef struct msq_frame {
  uint32_t struct_size;
  /** Pixels from one row to the next. 0 (default): the width of the tile. */
  uint32_t row_pixels;
  /** Infinity without a hit. */
  float* depth;
  /** 3 per pixel, as in msq_ray_hit, in model coordinates. 0 without a hit. */
  float* normal;
  /** As in msq_ray_hit. -1 without a hit. */
  int32_t* scale;
  /** As in msq_ray_hit. */
  uint32_t* material;
  /** 4 per pixel: red, green, blue in sRGB, and opacity. Not premultiplied. */
  uint8_t* rgba;
} msq_frame;

/** Sets the defaults: no arrays. Errors: ARGUMENT. */
MSQ_API msq_status msq_frame_init(msq_frame* frame, size_t size);

/** A pass of a rendering. */
typedef struct msq_render_pass {
  /** Out: sizeof(msq_render_pass) of the library. */
  uint32_t struct_size;
  /** Side in pixels of the blocks that share one ray. 1: each pixel has its own. */
  uint32_t step;
  /** rgba: samples along a side of a pixel. */
  uint32_t samples;
  /** 1: the picture is complete. */
  int32_t is_last;
} msq_render_pass;

/** Receives a pass. The frame contains a whole picture, to show or copy; the host must not change
 * it before the last pass. Return 0 to continue, or the host's code, preferably negative, to stop.
 * Exceptions of the host's language must not leave it. */
typedef int32_t (*msq_render_fn)(void* user, const msq_render_pass* pass);

/** Renders a model as a camera sees it.
 *
 * Depth, normal, scale and material of a pixel are those of msq_ray_cast for the ray through its
 * centre. Its colour is the mean, in linear light, of its samples: the background, or
 *
 *   base * (ambient * open + (1 - ambient) * max(0, normal . light) * lit)
 *
 * where base is the colour that colour_by selects, open is the share of occlusion rays that hit
 * nothing, and lit is 0 in shadow, otherwise 1. open and lit are 1 if not requested. What the clip
 * planes cut away casts no shadow. A pixel has the same bits for any tile, passes and threads.
 *
 * fn NULL: no callback. Otherwise fn is called on the calling thread after each pass: steps from
 * first_step, halved each time, down to 1; then one with all samples if rgba has more than one per
 * pixel. query NULL: defaults. job NULL: no job. ARGUMENT writes nothing; other errors may leave
 * the frame partly written.
 *
 * Cost: one ray per pixel and samples^2 more if samples > 1, each with its shadow and occlusion
 * rays; in parallel, in tiles of 32 x 32 rays. A mesh builds its tree first, as for
 * msq_point_distance. Memory: about 1 MB per thread, kept for the next call. Errors: ARGUMENT,
 * CANCELLED, HOST, LIMIT, MEMORY. Source: paper, section "Set Queries for Ray-Casting". */
MSQ_API msq_status msq_render(const msq_model* model, const msq_camera* camera,
                              const msq_render_def* def, const msq_query_def* query,
                              const msq_frame* frame, msq_render_fn fn, void* user, msq_job* job);

/* ---- Documents ------------------------------------------------------------------------------- */

/** A model with settings for slices and pictures, read from a text in JSON. docs/model_file.md
 * defines the format, docs/model.schema.json is its schema. */
typedef struct msq_document msq_document;

/** Which files a document may name. */
enum msq_document_files {
  /** Relative paths below base_directory, without "..", colons and backslashes. Symbolic links
   * there are followed. */
  MSQ_DOCUMENT_FILES_BELOW = 0,
  /** None. */
  MSQ_DOCUMENT_FILES_NONE = 1,
  /** Any: relative ones start at base_directory. For documents that the host trusts. */
  MSQ_DOCUMENT_FILES_ANY = 2
};

/** How a document is read. The limits protect the host from hostile documents. */
typedef struct msq_document_def {
  uint32_t struct_size;
  /** An msq_document_files. Default MSQ_DOCUMENT_FILES_BELOW. */
  int32_t files;
  /** Where relative paths start. NULL (default): msq_document_from_file takes the directory of the
   * document; a document from memory may then name no relative path. */
  const char* base_directory;
  /** Maximum size of the document in bytes. 0 and default: 64 MiB. */
  uint64_t max_bytes;
  /** Maximum number of values in the document: numbers, texts, lists and objects. 0 and default: 8
   * million. */
  uint64_t max_values;
  /** Maximum depth of nested lists and objects, at most 1024. 0 and default: 64. */
  uint32_t max_depth;
  /** Maximum number of files that the document names. 0 and default: 256. */
  uint32_t max_files;
  /** Maximum size in bytes of all these files together, and of what an archive among them unpacks
   * to. 0 and default: 4 GiB. */
  uint64_t max_file_bytes;
  /** Maximum number of triangles of each mesh file. 0 and default: 200 million. */
  uint64_t max_triangles;
} msq_document_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_document_def_init(msq_document_def* def, size_t size);

/** Reads a document from text in memory: JSON in UTF-8, of `bytes` bytes. def NULL: defaults. job
 * NULL: no job; its progress is that of the file which is being read.
 *
 * msq builds every object of the document with the functions above, with their checks and warnings.
 * Lengths are in the model's unit. Unknown keys, keys that occur twice and definitions
 * that contain themselves are refused. A message begins with line, column and path of the value
 * that is at fault, for example "12:17: scales[1].structure.foam.radius: ...". Lines and columns
 * begin at 1; columns count bytes.
 *
 * Cost: about 100 ns per value of the document, 40 bytes per value while it is read, and the cost
 * of the objects. Errors: ARGUMENT (text that is not JSON, a document that is not in the format, a
 * path that is not allowed, and as the functions that create its objects), IO, UNSUPPORTED (a build
 * without nlohmann-json), LIMIT, MESH, CANCELLED, MEMORY. */
MSQ_API msq_status msq_document_from_json(msq_context* context, const char* text, uint64_t bytes,
                                          const msq_document_def* def, msq_document** document,
                                          msq_job* job);

/** Reads a document from a file. path: as in msq_shape_from_file. Its messages begin with the path.
 * def NULL: defaults. job NULL: no job. The rest is as in msq_document_from_json. Errors: as
 * msq_document_from_json. */
MSQ_API msq_status msq_document_from_file(msq_context* context, const char* path,
                                          const msq_document_def* def, msq_document** document,
                                          msq_job* job);

/** Adds a reference. */
MSQ_API void msq_document_retain(msq_document* document);
/** Drops a reference. */
MSQ_API void msq_document_release(msq_document* document);

/** Contents of a document. */
typedef struct msq_document_report {
  uint32_t struct_size;
  /** Version of the format that the document names; now 1. */
  uint32_t version;
  /** 1 if it has settings for slices; 1 if it has settings for pictures. */
  int32_t has_slicing, has_view;
  /** Number of files that it names. */
  uint32_t files;
  uint32_t reserved;
  /** Its title in UTF-8, "" if it has none. Valid as long as the document. */
  const char* title;
} msq_document_report;

/** Reports the contents of a document. Errors: ARGUMENT. */
MSQ_API msq_status msq_document_info(const msq_document* document, msq_document_report* report);

/** Returns the model of a document, with a reference for the caller to release. The model does not
 * need the document any more. Errors: ARGUMENT. */
MSQ_API msq_status msq_document_model(const msq_document* document, msq_model** model);

/** Writes the settings for slices to *def, whose struct_size the caller has set. Fields that the
 * document does not set have their defaults. The pointers in it are valid as long as the document.
 * The host may change def before msq_slicer_create checks it. Errors: ARGUMENT (also a document
 * without slicing). */
MSQ_API msq_status msq_document_slicing(const msq_document* document, msq_slicer_def* def);

/** Writes the settings for pictures to *camera and *render, whose struct_size the caller has set.
 * A view along a direction is already fitted to the model, as by msq_camera_fit. The pointers in
 * *render are valid as long as the document. Errors: ARGUMENT (also a document without view). */
MSQ_API msq_status msq_document_view(const msq_document* document, msq_camera* camera,
                                     msq_render_def* render);

/** How a model is written. */
typedef struct msq_json_def {
  uint32_t struct_size;
  /** Must be 0. */
  uint32_t reserved;
  /** Paths of files below this directory become relative to it. It is compared as text. NULL
   * (default): paths are written as msq_shape_from_file got them. Relative paths of a document have
   * the base_directory of that document before them. */
  const char* base_directory;
  /** In UTF-8. NULL (default): none. */
  const char* title;
  /** Settings to write beside the model. NULL (default): none. camera and render go together. */
  const msq_slicer_def* slicing;
  const msq_camera* camera;
  const msq_render_def* render;
  /** Maximum number of values of an array that is written into the document: of the vertices and
   * triangles of a mesh, an image, beams. 0 and default: 1 million. */
  uint64_t max_numbers;
} msq_json_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_API msq_status msq_json_def_init(msq_json_def* def, size_t size);

/** Writes a model as a document in JSON: its objects as they were defined, whether by the functions
 * of this header or by a document. msq_document_from_json makes a model of it with the same
 * msq_model_hash, as long as the files that it names are the same. def NULL: defaults.
 *
 * Meshes from files are written as the path of the file with its options. Other meshes, and images
 * that no document read from a file, are written as numbers. Objects that are used more than once
 * are written once, under a name.
 *
 * *bytes: receives the size of the text, without a terminating 0. text: receives it if room is
 * enough, with a terminating 0 if room is larger; NULL if room is 0. Errors: ARGUMENT (also room
 * that is neither 0 nor enough), UNSUPPORTED (an object of the host; beams of more than 4 MiB,
 * whose definition msq does not keep; a path or a name that is not UTF-8; a build without
 * nlohmann-json), LIMIT (max_numbers), MEMORY. */
MSQ_API msq_status msq_model_to_json(const msq_model* model, const msq_json_def* def, char* text,
                                     uint64_t room, uint64_t* bytes);

#ifdef __cplusplus
}
#endif

#endif
