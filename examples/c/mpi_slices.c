/* SPDX-License-Identifier: Apache-2.0
 * Layers of a part on many machines: each process of MPI computes a range of layers, and all write
 * one file. The file has the same bytes for any number of processes.
 *
 * usage: mpirun -n 4 mpi_slices OUT.raw [PITCH]
 *
 * OUT.raw: the layers one after the other, bits as in PBM, rows padded to 8 bytes. */
#include <limits.h>
#include <mpi.h>
#include <msq.h>
#include <stdio.h>
#include <stdlib.h>

static int rank; /* of this process */

static void fail(const char* what, const char* why) {
  fprintf(stderr, "mpi_slices: process %d: %s: %s\n", rank, what, why);
  MPI_Abort(MPI_COMM_WORLD, 1); /* ends all processes */
}

static void check(msq_status status) {
  if (status != MSQ_OK) fail(msq_status_name(status), msq_error_message());
}

static void check_mpi(int status) {
  char why[MPI_MAX_ERROR_STRING];
  int length = 0;
  if (status == MPI_SUCCESS) return;
  MPI_Error_string(status, why, &length);
  fail("MPI", why);
}

/* A box of 40 x 30 x 20 mm, filled with a foam. Models cannot be sent, so each process makes its
 * own, in milliseconds. */
static msq_model* make_model(msq_context* context) {
  const double min[3] = {0, 0, 0}, max[3] = {40, 30, 20};
  msq_shape* box;
  check(msq_shape_from_box(context, min, max, &box));

  msq_foam_def foam_def;
  check(msq_foam_def_init(&foam_def, sizeof foam_def));
  for (int axis = 0; axis < 3; ++axis) foam_def.grid.cell_size[axis] = 2;
  foam_def.radius.value = 0.25;
  msq_structure* foam;
  check(msq_structure_foam(context, &foam_def, &foam));

  const msq_scale_def scales[2] = {{.shape = box}, {.structure = foam}};
  msq_model_def model_def;
  check(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  model_def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &model_def, &model));
  msq_structure_release(foam);
  msq_shape_release(box);
  return model;
}

typedef struct {
  MPI_File file;
  uint64_t layer_bytes;
  uint64_t inside; /* pixels */
} output;

/* Layers of a range come in ascending order. MPI counts bytes by int. */
static int32_t take_layer(void* user, const msq_layer* layer) {
  output* out = user;
  const MPI_Offset place = (MPI_Offset)(layer->index * out->layer_bytes);
  out->inside += layer->inside_count;
  check_mpi(MPI_File_write_at(out->file, place, layer->data, (int)out->layer_bytes, MPI_BYTE,
                              MPI_STATUS_IGNORE));
  return 0;
}

int main(int argc, char** argv) {
  int processes;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &processes);
  const double pitch = argc > 2 ? atof(argv[2]) : 0.1;
  if (argc < 2 || !(pitch > 0)) fail("usage", "mpi_slices OUT.raw [PITCH]");

  /* One thread per process, if there is a process per core. 0: all cores, with a process per
   * machine. */
  msq_context_def context_def;
  check(msq_context_def_init(&context_def, sizeof context_def));
  context_def.threads = 1;
  msq_context* context;
  check(msq_context_create(&context_def, &context));
  msq_model* model = make_model(context);

  msq_slicer_def plan;
  check(msq_slicer_def_init(&plan, sizeof plan));
  plan.pitch[0] = plan.pitch[1] = plan.layer_height = pitch;
  msq_slicer* slicer;
  check(msq_slicer_create(model, &plan, &slicer));
  msq_slicer_report size = {.struct_size = sizeof size};
  check(msq_slicer_info(slicer, &size));
  if (size.layer_bytes > INT_MAX) fail("the pitch is too small", "a layer has 2 GiB or more");

  /* Ranges that differ by one layer at most. They share nothing, so no process waits for another.
   */
  const uint64_t first = size.layer_count * (uint64_t)rank / (uint64_t)processes;
  const uint64_t end = size.layer_count * (uint64_t)(rank + 1) / (uint64_t)processes;
  output out = {.layer_bytes = size.layer_bytes};
  const double start = MPI_Wtime();
  check_mpi(MPI_File_open(MPI_COMM_WORLD, argv[1], MPI_MODE_CREATE | MPI_MODE_WRONLY, MPI_INFO_NULL,
                          &out.file));
  check_mpi(MPI_File_set_size(out.file, (MPI_Offset)(size.layer_count * size.layer_bytes)));
  if (end > first) check(msq_slicer_run(slicer, first, end - first, take_layer, &out, NULL));
  check_mpi(MPI_File_close(&out.file));

  uint64_t inside = 0;
  check_mpi(MPI_Reduce(&out.inside, &inside, 1, MPI_UINT64_T, MPI_SUM, 0, MPI_COMM_WORLD));
  if (rank == 0) {
    const double pixels = (double)size.width * size.height * (double)size.layer_count;
    printf("%d processes: %llu layers of %u x %u pixels in %.2f s, %.2f %% solid\n", processes,
           (unsigned long long)size.layer_count, size.width, size.height, MPI_Wtime() - start,
           100 * (double)inside / pixels);
  }

  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
  MPI_Finalize();
  return 0;
}
