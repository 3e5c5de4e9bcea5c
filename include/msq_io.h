/* SPDX-License-Identifier: Apache-2.0 */
/** @file
 * msq_io: writes what msq computes as files of printers and other programs. A companion of libmsq,
 * with the libraries that the formats need; libmsq itself links none of them.
 *
 * A writer takes the layers of a run:
 *
 *   msq_io_writer* writer;
 *   status = msq_io_png_create(slicer, "layers", NULL, NULL, &writer);
 *   status = msq_slicer_run(slicer, 0, UINT64_MAX, msq_io_writer_layer, writer, job);
 *   if (status == MSQ_OK || status == MSQ_E_HOST) status = msq_io_writer_finish(writer);
 *   msq_io_writer_release(writer);
 *
 * The rules of msq.h hold here, with these additions:
 *
 * Status. Functions return msq_status. The message of a failure is that of msq_io_error_message(),
 * also where msq refused what msq_io passed on to it.
 *
 * Files. Paths are in UTF-8. A file gets its name when it is complete. Until then it has a
 * temporary name in the same folder, ".<name>.<letters>.part". A call that fails or is cancelled,
 * and a full disk, leave neither. Only the end of the process, by a signal for example, can leave
 * the temporary one. Folders of a path must exist. replace 0: a file that has the name already is
 * left as it is, and the call is refused with MSQ_E_IO. replace 1: the new file takes its place in
 * one step.
 *
 * Same bytes. The bytes of a file depend on the layers and on the definitions, not on threads or
 * the clock.
 *
 * Every declaration exists since version 0.2 unless its comment says otherwise.
 */
#ifndef MSQ_IO_H
#define MSQ_IO_H

#include <stddef.h>
#include <stdint.h>

#include "msq.h"

#if defined(_WIN32) && defined(MSQ_IO_SHARED)
#ifdef MSQ_IO_BUILDING
#define MSQ_IO_API __declspec(dllexport)
#else
#define MSQ_IO_API __declspec(dllimport)
#endif
#elif defined(__GNUC__) && !defined(_WIN32)
#define MSQ_IO_API __attribute__((visibility("default")))
#else
#define MSQ_IO_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Version, errors ------------------------------------------------------------------------- */

/** Returns the version of the loaded library, in the form of MSQ_VERSION. */
MSQ_IO_API uint32_t msq_io_version(void);

/** Returns the message of the last failure of msq_io on the calling thread, in UTF-8; "" before the
 * first failure. The string is valid until the next failure on this thread. */
MSQ_IO_API const char* msq_io_error_message(void);

/* ---- Files ----------------------------------------------------------------------------------- */

/** A file that appears under its name when it is complete. One thread at a time may use it. */
typedef struct msq_io_file msq_io_file;

/** Begins a file. Errors: ARGUMENT, IO (the name exists and replace is 0; the folder does not
 * exist), MEMORY. */
MSQ_IO_API msq_status msq_io_file_create(const char* path, int32_t replace, msq_io_file** file);

/** Appends bytes. bytes may be NULL if size is 0. Errors: ARGUMENT (also after
 * msq_io_file_finish), IO (a full disk, for example). */
MSQ_IO_API msq_status msq_io_file_write(msq_io_file* file, const void* bytes, uint64_t size);

/** Writes a part of a file at its offset. An msq_file_fn, for msq_surface_file: user is the
 * msq_io_file. Returns MSQ_OK or the status of the failure, which msq_error_host_code() then
 * returns. Errors: as msq_io_file_write. */
MSQ_IO_API int32_t msq_io_file_part(void* user, const msq_file_part* part);

/** Completes the file: its bytes are on the disk, and it has its name. If an earlier call failed,
 * returns the same failure. A file that cannot be completed is removed. Errors: ARGUMENT, IO. */
MSQ_IO_API msq_status msq_io_file_finish(msq_io_file* file);

/** Frees the object. A file that was not completed is removed. NULL: does nothing. */
MSQ_IO_API void msq_io_file_release(msq_io_file* file);

/* ---- Writers of layers ----------------------------------------------------------------------- */

/** Takes the layers of a slicer, in order, and writes them to a file or a folder. One thread at a
 * time may use it. */
typedef struct msq_io_writer msq_io_writer;

/** What writers of all formats have in common. */
typedef struct msq_io_writer_def {
  uint32_t struct_size;
  /** Which of the outputs of a layer is written: its place in msq_layer.outputs. Default 0. */
  uint32_t output;
  /** Threads that encode, including the one that calls msq_io_writer_layer. 0 (default): one per
   * core. At most 256. 1: the calling thread only. Does not change the file. */
  uint32_t threads;
  /** 1: an existing file of the same name is replaced. 0 (default): it is an error. */
  int32_t replace;
  /** Bytes of layers that wait for threads or for the disk, and of encoded ones. The thread that
   * brings more encodes layers itself or waits, which holds msq back. A single layer may be larger.
   * Default 16 MiB. Does not change the file. */
  uint64_t queue_bytes;
  /** Layers that will come, as in msq_slicer_run. Defaults 0 and UINT64_MAX: to the last. */
  uint64_t first_layer;
  uint64_t layer_count;
} msq_io_writer_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_IO_API msq_status msq_io_writer_def_init(msq_io_writer_def* def, size_t size);

/** Takes a layer, copies what it needs, and returns while threads of the writer encode it. An
 * msq_layer_fn, for msq_slicer_run: user is the msq_io_writer. A host with a callback of its own
 * calls it from there, for any number of writers. Layers must come in order, each once.
 *
 * Returns MSQ_OK or the status of the failure of this layer or of an earlier one. That stops
 * msq_slicer_run with MSQ_E_HOST; msq_io_writer_finish then returns the failure itself. Errors:
 * ARGUMENT (also a layer out of order or of another size or output, and a writer that is finished),
 * IO, MEMORY; LIMIT as each format says. */
MSQ_IO_API int32_t msq_io_writer_layer(void* user, const msq_layer* layer);

/** Waits for the threads and completes the file or folder. If an earlier call failed, returns the
 * same failure. Then, and if not all layers came, nothing is left. A second call returns what the
 * first one did. Errors: ARGUMENT, IO, LIMIT, MEMORY. */
MSQ_IO_API msq_status msq_io_writer_finish(msq_io_writer* writer);

/** What a writer has done. */
typedef struct msq_io_writer_report {
  uint32_t struct_size;
  uint32_t reserved;
  /** Layers that came. */
  uint64_t layer_count;
  /** Of these, the layers whose bytes have been written. */
  uint64_t written_count;
  /** Bytes written so far; after msq_io_writer_finish the size of the file or of all files. */
  uint64_t bytes;
  /** Maximum number of bytes that were in the queue. */
  uint64_t peak_queue_bytes;
} msq_io_writer_report;

/** Reports what a writer has done. Errors: ARGUMENT. */
MSQ_IO_API msq_status msq_io_writer_info(const msq_io_writer* writer, msq_io_writer_report* report);

/** Frees the object. If it was not finished with success, it first stops its threads and removes
 * what they wrote. NULL: does nothing. */
MSQ_IO_API void msq_io_writer_release(msq_io_writer* writer);

/* ---- PNG ------------------------------------------------------------------------------------- */

/** Definition of a stack of PNG files. */
typedef struct msq_io_png_def {
  uint32_t struct_size;
  /** 0 (default): rows are stored as differences from the row above, whose zeros are compressed as
   * runs, with the Huffman codes of ISA-L. That is several times as fast as the other levels, and
   * smaller than level 1 for layers. In a build without ISA-L as level 1. 1 to 9: by libpng, at
   * that level of zlib. The pixels are the same. */
  int32_t level;
  /** Digits of the number of a layer in the name of its file, 1 to 20. Longer numbers have the
   * digits that they need. Default 5. */
  uint32_t digits;
  /** What names begin with: 1 to 64 bytes without / \ and control characters, not beginning with a
   * dot. NULL (default): "layer". */
  const char* prefix;
} msq_io_png_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_IO_API msq_status msq_io_png_def_init(msq_io_png_def* def, size_t size);

/** Begins a folder with one PNG file per layer: "layer00000.png" for layer 0 of the slicer. BITS
 * become images of 1 bit, BYTES and GREY of 8 bits; white is solid. The first row of the image is
 * row 0 of the layer, at the smallest y; MSQ_LAYER_MIRROR_Y turns the image upright.
 *
 * The folder is made if it does not exist; it then appears with all its files in one step. If it
 * exists, the files are added to it at the end, each in one step, and a failure removes them.
 *
 * writer_def, def NULL: defaults. Errors: ARGUMENT (also an output that is neither BITS,
 * BYTES nor GREY, once layers come), IO, LIMIT (a layer of 2^31 bytes or more), MEMORY. */
MSQ_IO_API msq_status msq_io_png_create(const msq_slicer* slicer, const char* path,
                                        const msq_io_writer_def* writer_def,
                                        const msq_io_png_def* def, msq_io_writer** writer);

/** Writes one picture of 8 bits per channel as a PNG file. channels: 1 (grey), 3 (RGB) or 4 (RGBA).
 * pixels: height rows from the top, stride bytes apart; stride 0: width * channels. Errors:
 * ARGUMENT, IO, LIMIT (a picture of 2^31 bytes or more), MEMORY. */
MSQ_IO_API msq_status msq_io_picture_save(const char* path, uint32_t width, uint32_t height,
                                          uint32_t channels, const uint8_t* pixels, uint64_t stride,
                                          int32_t replace);

/* ---- SL1 ------------------------------------------------------------------------------------- */

/** The panel of a resin printer, in PrusaSlicer's terms. The defaults are those of the Original
 * Prusa SL1. */
typedef struct msq_io_panel_def {
  uint32_t struct_size;
  /** display_orientation. 1 (default): portrait, images are turned: x of the model runs along their
   * columns. 0: landscape. */
  int32_t portrait;
  /** display_pixels_x and display_pixels_y: along x and y of the model. Default 2560 and 1440. */
  uint32_t pixels[2];
  /** display_width and display_height in millimetres: along x and y of the model. Default 120.96
   * and 68.04. */
  double size[2];
  /** display_mirror_x and display_mirror_y: 0 or 1. Default 1 and 0. */
  int32_t mirror[2];
} msq_io_panel_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_IO_API msq_status msq_io_panel_def_init(msq_io_panel_def* def, size_t size);

/** Sets the fields of a slicer's definition that a panel decides: resolution, region, orientation
 * and, if plan has no outputs, output = MSQ_LAYER_GREY. The part is centred on the panel; the
 * bottom of layer 0 is the bottom of the model. plan must come from msq_slicer_def_init and have
 * its layer_height. A unit of the model is a millimetre. Other fields of plan remain. panel NULL:
 * defaults. Errors: ARGUMENT (also a model of all space, and one larger than the panel). */
MSQ_IO_API msq_status msq_io_panel_plan(const msq_model* model, const msq_io_panel_def* panel,
                                        msq_slicer_def* plan);

/** Definition of an SL1 archive. Times are in seconds. Strings: UTF-8 without line breaks. */
typedef struct msq_io_sl1_def {
  uint32_t struct_size;
  /** As in msq_io_png_def. Default 0. */
  int32_t level;
  /** faded_layers: number of layers over which the time falls from the first to the others.
   * Default 10. */
  uint32_t faded_layers;
  /** NULL (default): those of msq_io_panel_def_init. Copied. */
  const msq_io_panel_def* panel;
  /** jobDir, which names of layers begin with; as prefix in msq_io_png_def. NULL (default):
   * "part". */
  const char* job;
  /** exposure_time. Default 8. */
  double exposure_time;
  /** initial_exposure_time. Default 35. */
  double initial_exposure_time;
  /** fast_tilt_time and slow_tilt_time: for layers that fill at most, and more than, area_fill
   * percent of the panel. Defaults 5, 8 and 50. They enter the estimate of the print time. */
  double fast_tilt_time;
  double slow_tilt_time;
  double area_fill;
  /** printer_model, printer_variant, sla_material_settings_id. NULL (default): "SL1", "default" and
   * "". */
  const char* printer_model;
  const char* printer_variant;
  const char* material;
  /** More lines "key = value" for prusaslicer.ini, each ended by a line feed. Keys that msq_io
   * writes are refused. NULL (default): none. */
  const char* settings;
  /** fileCreationTimestamp, in seconds since 1970-01-01 UTC, at least 315532800 (1980). 0
   * (default): that of 1980-01-01, so that the same layers make the same file. */
  int64_t created;
  /** layer_height in millimetres. 0 (default): the distance of the layers, which are then two at
   * least. */
  double layer_height;
  /** Of which the two thumbnails, of 400 x 400 and 800 x 480 pixels, are rendered when the writer
   * is created. NULL (default): no thumbnails. */
  const msq_model* thumbnail_model;
} msq_io_sl1_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_IO_API msq_status msq_io_sl1_def_init(msq_io_sl1_def* def, size_t size);

/** Begins an SL1 archive: config.ini and prusaslicer.ini with PrusaSlicer's keys, one PNG of 8 bits
 * per layer, and thumbnails. Layers must have the size of the panel, as msq_io_panel_plan makes
 * them, at even heights, and hold GREY or BYTES. writer_def, def NULL: defaults. job: for the
 * thumbnails; NULL: no job. Errors: ARGUMENT, CANCELLED, HOST, IO, LIMIT (as msq_io_png_create),
 * MEMORY. */
MSQ_IO_API msq_status msq_io_sl1_create(const msq_slicer* slicer, const char* path,
                                        const msq_io_writer_def* writer_def,
                                        const msq_io_sl1_def* def, msq_io_writer** writer,
                                        msq_job* job);

/* ---- SVG ------------------------------------------------------------------------------------- */

/** How layers are divided into SVG files. */
enum msq_io_svg_layout {
  /** One file with a group per layer, as Slic3r and PrusaSlicer write and read them: polygons,
   * white for outer rings and black for holes. */
  MSQ_IO_SVG_STACK = 1,
  /** A folder with a file per layer, each one path filled by the even-odd rule. */
  MSQ_IO_SVG_FILES = 2
};

/** Definition of SVG files of contours. */
typedef struct msq_io_svg_def {
  uint32_t struct_size;
  /** An msq_io_svg_layout. Default MSQ_IO_SVG_STACK. */
  int32_t layout;
  /** units of the contours (msq_contours_def), which coordinates are divided by. Default 1. */
  double units;
  /** Digits after the decimal point, 0 to 12. Default 4. Trailing zeros are left out. */
  uint32_t decimals;
  /** FILES: as in msq_io_png_def. Default 5. */
  uint32_t digits;
  /** FILES: as in msq_io_png_def. */
  const char* prefix;
} msq_io_svg_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_IO_API msq_status msq_io_svg_def_init(msq_io_svg_def* def, size_t size);

/** Begins an SVG file or a folder of them, from an output of CONTOURS (writer_def->output says
 * which). The picture is the rectangle of the slicer's pixels in model units, with y upwards;
 * width and height are given in millimetres. Coordinates are relative to its corner of smallest x
 * and largest y. Folders as for msq_io_png_create. writer_def, def NULL: defaults. Errors:
 * ARGUMENT, IO, MEMORY. */
MSQ_IO_API msq_status msq_io_svg_create(const msq_slicer* slicer, const char* path,
                                        const msq_io_writer_def* writer_def,
                                        const msq_io_svg_def* def, msq_io_writer** writer);

/* ---- Preview meshes -------------------------------------------------------------------------- */

/** Writes the mesh of msq_surface_file to a file. format: an msq_surface_format. job NULL: no job.
 * Cost and errors: as msq_surface_file; IO. */
MSQ_IO_API msq_status msq_io_surface_save(const msq_model* model, const msq_surface_def* def,
                                          int32_t format, const char* path, int32_t replace,
                                          msq_job* job);

/* ---- 3MF ------------------------------------------------------------------------------------- */

/** How struts are written as a beam lattice. */
typedef struct msq_io_beams_def {
  uint32_t struct_size;
  /** What the mesh is for: an msq_clipping. NONE (default): it is solid, and united with the beams.
   * INSIDE, OUTSIDE: the part of the beams inside or outside it is kept; the mesh itself is not
   * solid. */
  int32_t clipping;
  /** The mesh, in the coordinates of the struts. NULL (default): none. */
  const msq_mesh_def* mesh;
} msq_io_beams_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_IO_API msq_status msq_io_beams_def_init(msq_io_beams_def* def, size_t size);

/** Writes struts (msq_structure_strut_graph) to a 3MF file: a beam lattice with the radii and caps
 * of their ends. Struts of no length become balls, which need the extension for balls. A unit of
 * the model is a millimetre. Numbers are written with as many digits as it takes to read the same
 * doubles; msq_beam_file_open reads the same struts, and programs with float32 read these rounded.
 * replace as in msq_io_writer_def. def NULL: defaults. Cost: about 4 us per strut, most of
 * it for compression; some megabytes of memory. Errors: ARGUMENT (also a graph without struts), IO,
 * LIMIT (2^31 - 1 struts, nodes, vertices or triangles), MESH (no triangles, index out of range,
 * vertex that is not finite), MEMORY. */
MSQ_IO_API msq_status msq_io_beams_save(const msq_strut_graph* graph, const msq_io_beams_def* def,
                                        const char* path, int32_t replace);

/** Definition of a stack of slices. */
typedef struct msq_io_slices_def {
  uint32_t struct_size;
  uint32_t reserved;
  /** units of the contours (msq_contours_def), which coordinates are divided by. Default 1. */
  double units;
  /** Height of the layer, for a stack of one. Others end halfway between layers. Default 0. */
  double layer_height;
} msq_io_slices_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_IO_API msq_status msq_io_slices_def_init(msq_io_slices_def* def, size_t size);

/** Begins a 3MF file whose one object is a stack of slices, from an output of CONTOURS
 * (writer_def->output says which). x and y are u and v of the contours. The object's mesh is the
 * box about the slices, of low resolution: readers must know the slice extension. Numbers as in
 * msq_io_beams_save. writer_def, def NULL: defaults. The writer retains the slicer. Cost: about
 * 1 us per point. Memory: as other writers. Errors: ARGUMENT (also if all layers are empty, when
 * they have come), IO, LIMIT (4 GB of text before compression, 30 million points or more), MEMORY.
 */
MSQ_IO_API msq_status msq_io_slices_create(const msq_slicer* slicer, const char* path,
                                           const msq_io_writer_def* writer_def,
                                           const msq_io_slices_def* def, msq_io_writer** writer);

#ifdef __cplusplus
}
#endif

#endif
