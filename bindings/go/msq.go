// SPDX-License-Identifier: Apache-2.0

// Package msq fills parts with lattices, TPMS and Voronoi foams, without meshing them. It is a thin
// layer over the C ABI, whose header documents units, limits and errors. Objects are immutable and may
// be used by any number of goroutines; they are released when they are collected, or by Close.
//
// CGO_CFLAGS and CGO_LDFLAGS name the folders of msq.h and libmsq if the compiler does not find them.
package msq

/*
#cgo LDFLAGS: -lmsq
#include <msq.h>
#include <stdlib.h>

extern int32_t msqGoTakeLayer(void*, msq_layer*);

static int32_t take_layer(void* user, const msq_layer* layer) {
  return msqGoTakeLayer(user, (msq_layer*)layer);
}

static msq_status run(const msq_slicer* slicer, uint64_t first, uint64_t count, uintptr_t user,
                      msq_job* job) {
  return msq_slicer_run(slicer, first, count, take_layer, (void*)user, job);
}

static msq_status model_of(msq_context* context, const msq_shape* shape, const msq_structure* const* structures,
                           uint32_t count, msq_model** model) {
  msq_model_def def;
  msq_scale_def* const scales = calloc(count + 1, sizeof *scales);
  if (!scales) return MSQ_E_MEMORY;
  scales[0].shape = shape;
  for (uint32_t i = 0; i < count; ++i) scales[i + 1].structure = structures[i];
  msq_status status = msq_model_def_init(&def, sizeof def);
  def.scales = scales;
  def.scale_count = count + 1;
  def.scale_size = sizeof *scales;
  if (status == MSQ_OK) status = msq_model_create(context, &def, model);
  free(scales);
  return status;
}

// The coordinates are those of Go, for the time of the call.
static msq_status membership(const msq_model* model, const double* triples, uint64_t count, uint8_t* inside) {
  msq_points_def def;
  const msq_status status = msq_points_def_init(&def, sizeof def);
  if (status != MSQ_OK) return status;
  def.kind = MSQ_POINTS_ARRAY;
  def.coordinate_type = MSQ_FLOAT64;
  def.coordinates = triples;
  def.count = count;
  return msq_set_membership(model, &def, NULL, inside, count, NULL);
}
static msq_status distance(const msq_model* model, const double* triples, uint64_t count, double* distances) {
  msq_points_def def;
  const msq_status status = msq_points_def_init(&def, sizeof def);
  if (status != MSQ_OK) return status;
  def.kind = MSQ_POINTS_ARRAY;
  def.coordinate_type = MSQ_FLOAT64;
  def.coordinates = triples;
  def.count = count;
  return msq_set_distance(model, &def, NULL, distances, count, NULL);
}
*/
import "C"

import (
	"fmt"
	"math"
	"runtime"
	"runtime/cgo"
	"strings"
	"unsafe"
)

// Status is one of the MSQ_E_* of msq.h.
type Status int32

// What went wrong, as in msq.h.
const (
	ErrArgument    Status = C.MSQ_E_ARGUMENT
	ErrMemory      Status = C.MSQ_E_MEMORY
	ErrCancelled   Status = C.MSQ_E_CANCELLED
	ErrHost        Status = C.MSQ_E_HOST
	ErrIO          Status = C.MSQ_E_IO
	ErrUnsupported Status = C.MSQ_E_UNSUPPORTED
	ErrMesh        Status = C.MSQ_E_MESH
	ErrLimit       Status = C.MSQ_E_LIMIT
	ErrInternal    Status = C.MSQ_E_INTERNAL
)

// Error is a call of msq that failed. The message has the value and the limit.
type Error struct {
	Status  Status
	Message string
}

func (e *Error) Error() string {
	return C.GoString(C.msq_status_name(C.msq_status(e.Status))) + ": " + e.Message
}

// call runs calls of C on one thread, to which the message of a failure belongs.
func call(function func() C.msq_status) error {
	runtime.LockOSThread()
	defer runtime.UnlockOSThread()
	if status := function(); status != C.MSQ_OK {
		return &Error{Status(status), C.GoString(C.msq_error_message())}
	}
	return nil
}

func refusal(format string, values ...interface{}) error {
	return &Error{ErrArgument, fmt.Sprintf(format, values...)}
}

// countOf is a number of Go as one of C, from 0 to a limit.
func countOf(name string, value int, limit uint32) (C.uint32_t, error) {
	if value < 0 || uint64(value) > uint64(limit) {
		return 0, refusal("%s is %d; it must be from 0 to %d", name, value, limit)
	}
	return C.uint32_t(value), nil
}

// textOf is a copy of a text for C, where a zero byte ends it. The caller frees it.
func textOf(name, text string) (*C.char, error) {
	if at := strings.IndexByte(text, 0); at >= 0 {
		return nil, refusal("%s %q has a zero byte at %d", name, text, at)
	}
	return C.CString(text), nil
}

// Context has threads, cell cache and memory limit that objects share.
type Context struct{ raw *C.msq_context }

// NewContext makes a context with the defaults. threads 0: one per core.
func NewContext(threads int) (*Context, error) {
	made := &Context{}
	count, err := countOf("threads", threads, math.MaxUint32)
	if err != nil {
		return made, err
	}
	err = call(func() C.msq_status {
		var def C.msq_context_def
		if status := C.msq_context_def_init(&def, C.size_t(unsafe.Sizeof(def))); status != C.MSQ_OK {
			return status
		}
		def.threads = count
		return C.msq_context_create(&def, &made.raw)
	})
	runtime.SetFinalizer(made, (*Context).Close)
	return made, err
}

// Close drops the reference. Objects made in the context go on.
func (c *Context) Close() {
	C.msq_context_release(c.raw)
	c.raw = nil
}

// Job has progress and cancellation of one long call, from any goroutine.
type Job struct{ raw *C.msq_job }

// NewJob makes a job.
func NewJob() (*Job, error) {
	made := &Job{}
	err := call(func() C.msq_status { return C.msq_job_create(&made.raw) })
	runtime.SetFinalizer(made, (*Job).Close)
	return made, err
}

// Close drops the reference.
func (j *Job) Close() {
	C.msq_job_release(j.raw)
	j.raw = nil
}

// Cancel asks the call under the job to stop.
func (j *Job) Cancel() error {
	defer runtime.KeepAlive(j)
	return call(func() C.msq_status { return C.msq_job_cancel(j.raw) })
}

func (j *Job) pointer() *C.msq_job {
	if j == nil {
		return nil
	}
	return j.raw
}

// Shape is a coarse solid.
type Shape struct{ raw *C.msq_shape }

func shapeOf(create func(raw **C.msq_shape) C.msq_status) (*Shape, error) {
	made := &Shape{}
	err := call(func() C.msq_status { return create(&made.raw) })
	runtime.SetFinalizer(made, (*Shape).Close)
	return made, err
}

// Close drops the reference.
func (s *Shape) Close() {
	C.msq_shape_release(s.raw)
	s.raw = nil
}

// Box is the box between two corners.
func Box(context *Context, min, max [3]float64) (*Shape, error) {
	defer runtime.KeepAlive(context)
	return shapeOf(func(raw **C.msq_shape) C.msq_status {
		return C.msq_shape_from_box(context.raw, (*C.double)(&min[0]), (*C.double)(&max[0]), raw)
	})
}

// Sphere is a ball.
func Sphere(context *Context, center [3]float64, radius float64) (*Shape, error) {
	defer runtime.KeepAlive(context)
	return shapeOf(func(raw **C.msq_shape) C.msq_status {
		return C.msq_shape_from_sphere(context.raw, (*C.double)(&center[0]), C.double(radius), raw)
	})
}

// ShapeFromFile reads a mesh file in millimetres.
func ShapeFromFile(context *Context, path string) (*Shape, error) {
	defer runtime.KeepAlive(context)
	text, err := textOf("path", path)
	if err != nil {
		return &Shape{}, err
	}
	defer C.free(unsafe.Pointer(text))
	return shapeOf(func(raw **C.msq_shape) C.msq_status {
		return C.msq_shape_from_file(context.raw, text, nil, raw, nil)
	})
}

// Structure is a fine structure, which fills all space.
type Structure struct{ raw *C.msq_structure }

// Close drops the reference.
func (s *Structure) Close() {
	C.msq_structure_release(s.raw)
	s.raw = nil
}

// Foam is a Voronoi foam of one jittered seed per cell.
type Foam struct {
	CellSize [3]float64
	Radius   float64
	Seed     uint64
	// Stretch is how much longer the cells of the foam are along each axis of the grid. Zeros: not at all.
	Stretch [3]float64
	// Weight is the greatest radius of the seeds' spheres. Above 0, cells are those of a Laguerre tessellation.
	Weight float64
}

// NewFoam makes a foam.
func NewFoam(context *Context, foam Foam) (*Structure, error) {
	defer runtime.KeepAlive(context)
	made := &Structure{}
	err := call(func() C.msq_status {
		var def C.msq_foam_def
		if status := C.msq_foam_def_init(&def, C.size_t(unsafe.Sizeof(def))); status != C.MSQ_OK {
			return status
		}
		for axis, size := range foam.CellSize {
			def.grid.cell_size[axis] = C.double(size)
		}
		def.radius.value = C.double(foam.Radius)
		def.seed = C.uint64_t(foam.Seed)
		def.weight = C.double(foam.Weight)
		if foam.Stretch != [3]float64{} {
			for axis, stretch := range foam.Stretch {
				def.stretch[axis] = C.double(stretch)
			}
		}
		return C.msq_structure_foam(context.raw, &def, &made.raw)
	})
	runtime.SetFinalizer(made, (*Structure).Close)
	return made, err
}

// Model is a shape, filled with structures from coarse to fine.
type Model struct{ raw *C.msq_model }

func modelOf(create func(raw **C.msq_model) C.msq_status) (*Model, error) {
	made := &Model{}
	err := call(func() C.msq_status { return create(&made.raw) })
	runtime.SetFinalizer(made, (*Model).Close)
	return made, err
}

// NewModel makes a model.
func NewModel(context *Context, shape *Shape, structures ...*Structure) (*Model, error) {
	defer runtime.KeepAlive(context)
	defer runtime.KeepAlive(shape)
	defer runtime.KeepAlive(structures)
	count, err := countOf("the number of structures", len(structures), math.MaxUint32-1) // the shape is one scale more
	if err != nil {
		return &Model{}, err
	}
	raws := make([]*C.msq_structure, len(structures)+1) // no empty array
	for i, structure := range structures {
		raws[i] = structure.raw
	}
	return modelOf(func(raw **C.msq_model) C.msq_status {
		return C.model_of(context.raw, shape.raw, &raws[0], count, raw)
	})
}

// Close drops the reference.
func (m *Model) Close() {
	C.msq_model_release(m.raw)
	m.raw = nil
}

// Hash is equal for equal models, on every machine.
func (m *Model) Hash() (hash [16]byte, err error) {
	defer runtime.KeepAlive(m)
	err = call(func() C.msq_status { return C.msq_model_hash(m.raw, (*C.uint8_t)(&hash[0])) })
	return
}

// Membership says of each point whether it is inside.
func (m *Model) Membership(points [][3]float64) ([]bool, error) {
	defer runtime.KeepAlive(m)
	inside := make([]bool, len(points))
	if len(points) == 0 {
		return inside, nil
	}
	return inside, call(func() C.msq_status {
		return C.membership(m.raw, (*C.double)(&points[0][0]), C.uint64_t(len(points)),
			(*C.uint8_t)(unsafe.Pointer(&inside[0])))
	})
}

// Distance is positive outside, and never too large in magnitude.
func (m *Model) Distance(points [][3]float64) ([]float64, error) {
	defer runtime.KeepAlive(m)
	distances := make([]float64, len(points))
	if len(points) == 0 {
		return distances, nil
	}
	return distances, call(func() C.msq_status {
		return C.distance(m.raw, (*C.double)(&points[0][0]), C.uint64_t(len(points)),
			(*C.double)(&distances[0]))
	})
}

// Document is a model with settings for slices, from JSON.
type Document struct{ raw *C.msq_document }

// DocumentFromJSON reads a text.
func DocumentFromJSON(context *Context, text []byte) (*Document, error) {
	defer runtime.KeepAlive(context)
	made, copied := &Document{}, C.CBytes(text)
	defer C.free(copied)
	err := call(func() C.msq_status {
		return C.msq_document_from_json(context.raw, (*C.char)(copied), C.uint64_t(len(text)), nil,
			&made.raw, nil)
	})
	runtime.SetFinalizer(made, (*Document).Close)
	return made, err
}

// Close drops the reference.
func (d *Document) Close() {
	C.msq_document_release(d.raw)
	d.raw = nil
}

// Title is "" if there is none.
func (d *Document) Title() (title string, err error) {
	defer runtime.KeepAlive(d)
	err = call(func() C.msq_status {
		var report C.msq_document_report
		report.struct_size = C.uint32_t(unsafe.Sizeof(report))
		status := C.msq_document_info(d.raw, &report)
		if status == C.MSQ_OK {
			title = C.GoString(report.title)
		}
		return status
	})
	return
}

// Model is the document's model.
func (d *Document) Model() (*Model, error) {
	defer runtime.KeepAlive(d)
	return modelOf(func(raw **C.msq_model) C.msq_status { return C.msq_document_model(d.raw, raw) })
}

// Slicer has the layers that the document's settings describe.
func (d *Document) Slicer() (*Slicer, error) {
	defer runtime.KeepAlive(d)
	model, err := d.Model()
	if err != nil {
		return nil, err
	}
	return slicerOf(model, func(def *C.msq_slicer_def) C.msq_status {
		return C.msq_document_slicing(d.raw, def)
	})
}

// Slicer has the layers of a model.
type Slicer struct {
	raw           *C.msq_slicer
	Width, Height int
	LayerCount    uint64
}

// Plan says how a model is cut into layers.
type Plan struct{ Pitch, LayerHeight float64 }

// Slicer makes the layers of a model.
func (m *Model) Slicer(plan Plan) (*Slicer, error) {
	return slicerOf(m, func(def *C.msq_slicer_def) C.msq_status {
		def.pitch[0], def.pitch[1] = C.double(plan.Pitch), C.double(plan.Pitch)
		def.layer_height = C.double(plan.LayerHeight)
		return C.MSQ_OK
	})
}

func slicerOf(model *Model, set func(def *C.msq_slicer_def) C.msq_status) (*Slicer, error) {
	defer runtime.KeepAlive(model)
	made := &Slicer{}
	err := call(func() C.msq_status {
		def := (*C.msq_slicer_def)(C.calloc(1, C.sizeof_msq_slicer_def)) // it has pointers of C
		defer C.free(unsafe.Pointer(def))
		status := C.msq_slicer_def_init(def, C.sizeof_msq_slicer_def)
		if status == C.MSQ_OK {
			status = set(def)
		}
		if status == C.MSQ_OK {
			status = C.msq_slicer_create(model.raw, def, &made.raw)
		}
		var report C.msq_slicer_report
		report.struct_size = C.uint32_t(unsafe.Sizeof(report))
		if status == C.MSQ_OK {
			status = C.msq_slicer_info(made.raw, &report)
		}
		made.Width, made.Height = int(report.width), int(report.height)
		made.LayerCount = uint64(report.layer_count)
		return status
	})
	runtime.SetFinalizer(made, (*Slicer).Close)
	return made, err
}

// Close drops the reference.
func (s *Slicer) Close() {
	C.msq_slicer_release(s.raw)
	s.raw = nil
}

// Layer is valid until the function that gets it returns: Data is memory of msq.
type Layer struct {
	Index         uint64
	Z             float64
	Width, Height int
	// Bytes from one row to the next.
	Stride      int
	InsideCount uint64
	// Height rows of Stride bytes.
	Data []byte
}

type taker struct {
	take     func(Layer) error
	err      error
	panicked bool
	panic    interface{} // nil of panic(nil)
}

//export msqGoTakeLayer
func msqGoTakeLayer(user unsafe.Pointer, layer *C.msq_layer) (code C.int32_t) {
	taker := cgo.Handle(uintptr(user)).Value().(*taker)
	taker.panicked = true
	defer func() {
		if taker.panicked {
			taker.panic, code = recover(), -1 // none may pass through C
		}
	}()
	given := Layer{
		Index: uint64(layer.index), Z: float64(layer.z), Width: int(layer.width),
		Height: int(layer.height), Stride: int(layer.stride), InsideCount: uint64(layer.inside_count),
	}
	if layer.data != nil {
		given.Data = unsafe.Slice((*byte)(layer.data), given.Stride*given.Height)
	}
	taker.err = taker.take(given)
	taker.panicked = false
	if taker.err != nil {
		return -1
	}
	return 0
}

// Run gives count layers from first on to a function, in order, while others are computed. An error of
// the function stops the run and is returned; a panic goes on. The function
// must not end its goroutine (runtime.Goexit, FailNow of a test). job may be nil.
func (s *Slicer) Run(first, count uint64, job *Job, take func(Layer) error) error {
	defer runtime.KeepAlive(s)
	defer runtime.KeepAlive(job)
	taker := &taker{take: take}
	handle := cgo.NewHandle(taker)
	defer handle.Delete()
	err := call(func() C.msq_status {
		return C.run(s.raw, C.uint64_t(first), C.uint64_t(count), C.uintptr_t(handle), job.pointer())
	})
	if taker.panicked {
		panic(taker.panic)
	}
	if taker.err != nil {
		end := s.LayerCount
		if count < end-first {
			end = first + count
		}
		return fmt.Errorf("layers %d to %d: %w", first, end, taker.err)
	}
	return err
}
