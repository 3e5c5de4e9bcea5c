/* SPDX-License-Identifier: Apache-2.0 */
/** @file
 * msq_io: writes results of msq as files for printers and other programs. It is a library beside
 * libmsq and links the libraries that the formats need. libmsq itself links none of them.
 *
 * A writer receives the layers of a run:
 *
 *   msq_io_writer* writer;
 *   status = msq_io_png_create(slicer, "layers", NULL, NULL, &writer);
 *   status = msq_slicer_run(slicer, 0, UINT64_MAX, msq_io_writer_layer, writer, job);
 *   if (status == MSQ_OK || status == MSQ_E_HOST) status = msq_io_writer_finish(writer);
 *   msq_io_writer_release(writer);
 *
 * The rules of msq.h hold here, with these additions:
 *
 * Status. Functions return msq_status. msq_io_error_message() returns the message of a failure,
 * also if msq itself failed in a call of msq_io.
 *
 * Files. Paths are in UTF-8. A file gets its name when it is complete. Until then it has a
 * temporary name in the same folder, ".<name>.<letters>.part", with the whole characters in the
 * first 240 bytes of a longer name. After a failure, a cancelled call or on a full disk neither
 * file is left. A process that is killed, or ends before msq_io_writer_release, leaves the
 * temporary file. Folders of a path must exist. replace 0: if a file of this name exists, it stays
 * as it is, and the call returns MSQ_E_IO. replace 1: the new file replaces it in one step and
 * keeps its permissions.
 *
 * Same bytes. The bytes of a file depend on the layers and on the definitions, not on the number of
 * threads or the clock.
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

/** Creates a file. Errors: ARGUMENT, IO (the name exists and replace is 0; the folder does not
 * exist), MEMORY. */
MSQ_IO_API msq_status msq_io_file_create(const char* path, int32_t replace, msq_io_file** file);

/** Appends bytes. bytes may be NULL if size is 0. Errors: ARGUMENT (also after
 * msq_io_file_finish), IO (a full disk, for example). */
MSQ_IO_API msq_status msq_io_file_write(msq_io_file* file, const void* bytes, uint64_t size);

/** Writes a part of a file at its offset. It is an msq_file_fn for msq_surface_file, where user is
 * the msq_io_file. Returns MSQ_OK, or the status of a failure, which msq_error_host_code() then
 * returns too. Errors: as msq_io_file_write. */
MSQ_IO_API int32_t msq_io_file_part(void* user, const msq_file_part* part);

/** Completes the file: writes its bytes to the disk and gives it its name. If an earlier write
 * failed, returns the same failure; refused arguments do not count. A file that cannot be completed
 * is removed. Errors: ARGUMENT, IO. */
MSQ_IO_API msq_status msq_io_file_finish(msq_io_file* file);

/** Frees the object. A file that was not completed is removed. NULL: does nothing. */
MSQ_IO_API void msq_io_file_release(msq_io_file* file);

/* ---- Writers of layers ----------------------------------------------------------------------- */

/** Receives the layers of a slicer in order and writes them to a file or a folder. One thread at a
 * time may use it. */
typedef struct msq_io_writer msq_io_writer;

/** Options of writers of all formats. */
typedef struct msq_io_writer_def {
  uint32_t struct_size;
  /** Index in msq_layer.outputs of the output that is written. Default 0. */
  uint32_t output;
  /** Number of threads that encode, including the one that calls msq_io_writer_layer, at most 256.
   * 0 (default): one per core. 1: the calling thread only. Does not change the file. */
  uint32_t threads;
  /** 1: an existing file of the same name is replaced. 0 (default): an existing file is an error.
   */
  int32_t replace;
  /** Maximum number of bytes of layers that wait for threads or for the disk, encoded or not. If
   * there are more, the thread that calls msq_io_writer_layer encodes layers itself or waits. A
   * single layer may be larger. Default 16 MiB. Does not change the file. */
  uint64_t queue_bytes;
  /** Layers that the writer will receive, as in msq_slicer_run. Defaults 0 and UINT64_MAX: from the
   * first to the last. */
  uint64_t first_layer;
  uint64_t layer_count;
} msq_io_writer_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_IO_API msq_status msq_io_writer_def_init(msq_io_writer_def* def, size_t size);

/** Receives a layer and copies what it needs. Threads of the writer encode the layer after the
 * call. It is an msq_layer_fn for msq_slicer_run, where user is the msq_io_writer. A host with its
 * own callback may call it there, for any number of writers. Layers must come in order, each once.
 *
 * Returns MSQ_OK, or the status of the failure of this layer or of an earlier one. A failure stops
 * msq_slicer_run with MSQ_E_HOST. msq_io_writer_finish then returns the failure itself. Errors:
 * ARGUMENT (also a layer out of order or of another size or output, and a writer that is finished),
 * IO, MEMORY; LIMIT as described for each format. */
MSQ_IO_API int32_t msq_io_writer_layer(void* user, const msq_layer* layer);

/** Waits for the threads and completes the file or folder. If an earlier call failed, returns the
 * same failure. After a failure, and if layers are missing, no file is left. A second call returns
 * the same status. Errors: ARGUMENT, IO, LIMIT, MEMORY. */
MSQ_IO_API msq_status msq_io_writer_finish(msq_io_writer* writer);

/** State of a writer. */
typedef struct msq_io_writer_report {
  uint32_t struct_size;
  uint32_t reserved;
  /** Layers received. */
  uint64_t layer_count;
  /** Layers written. */
  uint64_t written_count;
  /** Bytes written. After msq_io_writer_finish: the size of the file, or of all files. */
  uint64_t bytes;
  /** Maximum number of bytes that were in the queue. */
  uint64_t peak_queue_bytes;
} msq_io_writer_report;

/** Returns the state of a writer. Errors: ARGUMENT. */
MSQ_IO_API msq_status msq_io_writer_info(const msq_io_writer* writer, msq_io_writer_report* report);

/** Frees the object. If it was not finished with success, first stops its threads and removes what
 * they wrote. NULL: does nothing. */
MSQ_IO_API void msq_io_writer_release(msq_io_writer* writer);

/* ---- PNG ------------------------------------------------------------------------------------- */

/** Definition of a stack of PNG files. */
typedef struct msq_io_png_def {
  uint32_t struct_size;
  /** 0 (default): rows are stored as differences from the row above. Runs of zeros and the Huffman
   * codes of ISA-L compress them. This is several times as fast as the other levels, and layers
   * become smaller than at level 1. A build without ISA-L uses level 1 instead. 1 to 9: libpng
   * compresses at this level of zlib. The pixels are the same. */
  int32_t level;
  /** Minimum number of digits of a layer's number in the name of its file, 1 to 20. Default 5. */
  uint32_t digits;
  /** Beginning of the names: 1 to 64 bytes without / \ : and control characters, and without a dot
   * at the beginning. NULL (default): "layer". */
  const char* prefix;
} msq_io_png_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_IO_API msq_status msq_io_png_def_init(msq_io_png_def* def, size_t size);

/** Creates a writer of a folder with one PNG file per layer: "layer00000.png" for layer 0 of the
 * slicer. BITS become images of 1 bit per pixel, BYTES and GREY of 8 bits; white is solid. The
 * first row of the image is row 0 of the layer, at the smallest y. With MSQ_LAYER_MIRROR_Y y points
 * upwards in the image.
 *
 * If the folder does not exist, it is created, and appears with all its files in one step. If it
 * exists, msq_io_writer_finish adds the files to it, each in one step; a failure removes them.
 *
 * writer_def, def NULL: defaults. Errors: ARGUMENT (for an output that is neither BITS, BYTES nor
 * GREY: when the first layer comes), IO, LIMIT (a layer of 2^31 bytes or more), MEMORY. */
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
  /** display_orientation. 1 (default): portrait; x of the model runs along the columns of the
   * images. 0: landscape. */
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

/** Sets the fields of a slicer's definition that depend on the panel: resolution, region,
 * orientation and, if plan has no outputs, output = MSQ_LAYER_GREY. The part is centred on the
 * panel. plan must come from msq_slicer_def_init and have a layer_height or layer_z. The bottom of
 * layer 0 is the bottom of the model, unless layer_z lists the layers. The unit of the model must
 * be the millimetre. Other fields of plan stay as they are. panel NULL: defaults. Errors: ARGUMENT
 * (also for a model of all space, and for one larger than the panel). */
MSQ_IO_API msq_status msq_io_panel_plan(const msq_model* model, const msq_io_panel_def* panel,
                                        msq_slicer_def* plan);

/** Definition of an SL1 archive. Times are in seconds. Strings: UTF-8 without line breaks. */
typedef struct msq_io_sl1_def {
  uint32_t struct_size;
  /** As in msq_io_png_def. Default 0. */
  int32_t level;
  /** faded_layers: number of layers over which the exposure time falls from initial_exposure_time
   * to exposure_time. Default 10. */
  uint32_t faded_layers;
  /** NULL (default): those of msq_io_panel_def_init. Copied. */
  const msq_io_panel_def* panel;
  /** jobDir, the beginning of the names of layers; limits as for prefix in msq_io_png_def. NULL
   * (default): "part". */
  const char* job;
  /** exposure_time. Default 8. */
  double exposure_time;
  /** initial_exposure_time. Default 35. */
  double initial_exposure_time;
  /** fast_tilt_time is for layers that fill at most area_fill percent of the panel, slow_tilt_time
   * for others. Defaults 5, 8 and 50. The estimate of the print time uses them. */
  double fast_tilt_time;
  double slow_tilt_time;
  double area_fill;
  /** printer_model, printer_variant, sla_material_settings_id. NULL (default): "SL1", "default" and
   * "". */
  const char* printer_model;
  const char* printer_variant;
  const char* material;
  /** Other lines "key = value" for prusaslicer.ini, each with a line feed at its end. Keys that
   * msq_io writes itself are errors. NULL (default): none. */
  const char* settings;
  /** fileCreationTimestamp, in seconds since 1970-01-01 UTC, from 315532800 (1980) to 4354819199
   * (2107). 0 (default): that of 1980-01-01, so that the same layers make the same file. */
  int64_t created;
  /** layer_height in millimetres. 0 (default): the distance between the slicer's layers; there must
   * then be at least two. */
  double layer_height;
  /** Model of the two thumbnails, of 400 x 400 and 800 x 480 pixels. They are rendered when the
   * writer is created. NULL (default): no thumbnails. */
  const msq_model* thumbnail_model;
} msq_io_sl1_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_IO_API msq_status msq_io_sl1_def_init(msq_io_sl1_def* def, size_t size);

/** Creates a writer of an SL1 archive: config.ini and prusaslicer.ini with PrusaSlicer's keys, one
 * PNG of 8 bits per pixel per layer, and thumbnails. Layers must have the size of the panel
 * (msq_io_panel_plan), an output of GREY or BYTES, and equal distances to 1/1000 of the layer
 * height, also outside the window of writer_def. writer_def, def NULL: defaults. job: cancels the
 * rendering of thumbnails; NULL: no job. Errors: ARGUMENT, CANCELLED, HOST, IO, LIMIT (as
 * msq_io_png_create), MEMORY. */
MSQ_IO_API msq_status msq_io_sl1_create(const msq_slicer* slicer, const char* path,
                                        const msq_io_writer_def* writer_def,
                                        const msq_io_sl1_def* def, msq_io_writer** writer,
                                        msq_job* job);

/* ---- SVG ------------------------------------------------------------------------------------- */

/** How layers are divided into SVG files. */
enum msq_io_svg_layout {
  /** One file with a group per layer, in the form of Slic3r and PrusaSlicer: polygons, white for
   * outer rings and black for holes. */
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

/** Creates a writer of an SVG file, or of a folder of SVG files, from the output of CONTOURS that
 * writer_def->output selects. The picture is the rectangle of the slicer's pixels in model units,
 * with y upwards. Its width and height are in millimetres. Coordinates are relative to its corner
 * of smallest x and largest y. Folders are created as by msq_io_png_create. writer_def, def NULL:
 * defaults. Errors: ARGUMENT, IO, MEMORY. */
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

/** Definition of a beam lattice. */
typedef struct msq_io_beams_def {
  uint32_t struct_size;
  /** Meaning of the mesh, an msq_clipping. NONE (default): the mesh is solid too. INSIDE, OUTSIDE:
   * only the part of the beams inside or outside the mesh is kept, and the mesh is not solid. */
  int32_t clipping;
  /** The mesh, in the coordinates of the struts. NULL (default): none. */
  const msq_mesh_def* mesh;
} msq_io_beams_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_IO_API msq_status msq_io_beams_def_init(msq_io_beams_def* def, size_t size);

/** Writes struts (msq_structure_strut_graph) to a 3MF file: a beam lattice with the radii and caps
 * of their ends. Struts of length 0 become balls, for which readers need the extension for balls.
 * The unit of the model must be the millimetre. Numbers have enough digits to read the same doubles
 * again: msq_beam_file_open reads the same struts. Programs with float32 round them. Struts
 * of radius 0 at both ends have no volume and are left out. replace as in msq_io_writer_def. def
 * NULL: defaults. Cost: about 4 us per strut, mostly compression; some megabytes of memory. Errors:
 * ARGUMENT (also a graph without struts, or with none that has a volume), IO,
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
  /** Height of the layer if the slicer has only one. The slices of several layers end halfway
   * between them, and the lowest and the highest layer are in the middle of their slices. Layers
   * that first_layer and layer_count of the writer select have the heights that they have in the
   * whole stack; a slicer with a window of layers is a stack by itself. Default 0. */
  double layer_height;
} msq_io_slices_def;

/** Sets the defaults. Errors: ARGUMENT. */
MSQ_IO_API msq_status msq_io_slices_def_init(msq_io_slices_def* def, size_t size);

/** Creates a writer of a 3MF file whose one object is a stack of slices, from the output of
 * CONTOURS that writer_def->output selects. x and y are u and v of the contours. The object's mesh
 * is only the box around the slices, so readers must support the slice extension. Numbers as in
 * msq_io_beams_save. writer_def, def NULL: defaults. The writer retains the slicer. Cost: about
 * 1 us per point. Memory: as other writers. Errors: ARGUMENT (if all layers are empty: from
 * msq_io_writer_finish), IO, LIMIT (4 GB of text before compression, 30 million points or more),
 * MEMORY.
 */
MSQ_IO_API msq_status msq_io_slices_create(const msq_slicer* slicer, const char* path,
                                           const msq_io_writer_def* writer_def,
                                           const msq_io_slices_def* def, msq_io_writer** writer);

#ifdef __cplusplus
}
#endif

#endif
