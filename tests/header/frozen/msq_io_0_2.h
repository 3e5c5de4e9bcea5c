/* SPDX-License-Identifier: Apache-2.0
 * What msq_io.h declared when its version was frozen, without the comments. Written by
 * tests/header/check_abi.py --freeze, and not edited: programs were compiled with this. */
/* clang-format off */
#ifndef MSQ_IO_H
#define MSQ_IO_H

#include <stddef.h>
#include <stdint.h>

#include "msq_0_2.h"

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

MSQ_IO_API uint32_t msq_io_version(void);

MSQ_IO_API const char* msq_io_error_message(void);

typedef struct msq_io_file msq_io_file;

MSQ_IO_API msq_status msq_io_file_create(const char* path, int32_t replace, msq_io_file** file);

MSQ_IO_API msq_status msq_io_file_write(msq_io_file* file, const void* bytes, uint64_t size);

MSQ_IO_API int32_t msq_io_file_part(void* user, const msq_file_part* part);

MSQ_IO_API msq_status msq_io_file_finish(msq_io_file* file);

MSQ_IO_API void msq_io_file_release(msq_io_file* file);

typedef struct msq_io_writer msq_io_writer;

typedef struct msq_io_writer_def {
  uint32_t struct_size;
  uint32_t output;
  uint32_t threads;
  int32_t replace;
  uint64_t queue_bytes;
  uint64_t first_layer;
  uint64_t layer_count;
} msq_io_writer_def;

MSQ_IO_API msq_status msq_io_writer_def_init(msq_io_writer_def* def, size_t size);

MSQ_IO_API int32_t msq_io_writer_layer(void* user, const msq_layer* layer);

MSQ_IO_API msq_status msq_io_writer_finish(msq_io_writer* writer);

typedef struct msq_io_writer_report {
  uint32_t struct_size;
  uint32_t reserved;
  uint64_t layer_count;
  uint64_t written_count;
  uint64_t bytes;
  uint64_t peak_queue_bytes;
} msq_io_writer_report;

MSQ_IO_API msq_status msq_io_writer_info(const msq_io_writer* writer, msq_io_writer_report* report);

MSQ_IO_API void msq_io_writer_release(msq_io_writer* writer);

typedef struct msq_io_png_def {
  uint32_t struct_size;
  int32_t level;
  uint32_t digits;
  const char* prefix;
} msq_io_png_def;

MSQ_IO_API msq_status msq_io_png_def_init(msq_io_png_def* def, size_t size);

MSQ_IO_API msq_status msq_io_png_create(const msq_slicer* slicer, const char* path,
                                        const msq_io_writer_def* writer_def,
                                        const msq_io_png_def* def, msq_io_writer** writer);

MSQ_IO_API msq_status msq_io_picture_save(const char* path, uint32_t width, uint32_t height,
                                          uint32_t channels, const uint8_t* pixels, uint64_t stride,
                                          int32_t replace);

typedef struct msq_io_panel_def {
  uint32_t struct_size;
  int32_t portrait;
  uint32_t pixels[2];
  double size[2];
  int32_t mirror[2];
} msq_io_panel_def;

MSQ_IO_API msq_status msq_io_panel_def_init(msq_io_panel_def* def, size_t size);

MSQ_IO_API msq_status msq_io_panel_plan(const msq_model* model, const msq_io_panel_def* panel,
                                        msq_slicer_def* plan);

typedef struct msq_io_sl1_def {
  uint32_t struct_size;
  int32_t level;
  uint32_t faded_layers;
  const msq_io_panel_def* panel;
  const char* job;
  double exposure_time;
  double initial_exposure_time;
  double fast_tilt_time;
  double slow_tilt_time;
  double area_fill;
  const char* printer_model;
  const char* printer_variant;
  const char* material;
  const char* settings;
  int64_t created;
  double layer_height;
  const msq_model* thumbnail_model;
} msq_io_sl1_def;

MSQ_IO_API msq_status msq_io_sl1_def_init(msq_io_sl1_def* def, size_t size);

MSQ_IO_API msq_status msq_io_sl1_create(const msq_slicer* slicer, const char* path,
                                        const msq_io_writer_def* writer_def,
                                        const msq_io_sl1_def* def, msq_io_writer** writer,
                                        msq_job* job);

enum msq_io_svg_layout {
  MSQ_IO_SVG_STACK = 1,
  MSQ_IO_SVG_FILES = 2
};

typedef struct msq_io_svg_def {
  uint32_t struct_size;
  int32_t layout;
  double units;
  uint32_t decimals;
  uint32_t digits;
  const char* prefix;
} msq_io_svg_def;

MSQ_IO_API msq_status msq_io_svg_def_init(msq_io_svg_def* def, size_t size);

MSQ_IO_API msq_status msq_io_svg_create(const msq_slicer* slicer, const char* path,
                                        const msq_io_writer_def* writer_def,
                                        const msq_io_svg_def* def, msq_io_writer** writer);

MSQ_IO_API msq_status msq_io_surface_save(const msq_model* model, const msq_surface_def* def,
                                          int32_t format, const char* path, int32_t replace,
                                          msq_job* job);

typedef struct msq_io_beams_def {
  uint32_t struct_size;
  int32_t clipping;
  const msq_mesh_def* mesh;
} msq_io_beams_def;

MSQ_IO_API msq_status msq_io_beams_def_init(msq_io_beams_def* def, size_t size);

MSQ_IO_API msq_status msq_io_beams_save(const msq_strut_graph* graph, const msq_io_beams_def* def,
                                        const char* path, int32_t replace);

typedef struct msq_io_slices_def {
  uint32_t struct_size;
  uint32_t reserved;
  double units;
  double layer_height;
} msq_io_slices_def;

MSQ_IO_API msq_status msq_io_slices_def_init(msq_io_slices_def* def, size_t size);

MSQ_IO_API msq_status msq_io_slices_create(const msq_slicer* slicer, const char* path,
                                           const msq_io_writer_def* writer_def,
                                           const msq_io_slices_def* def, msq_io_writer** writer);

#ifdef __cplusplus
}
#endif

#endif
