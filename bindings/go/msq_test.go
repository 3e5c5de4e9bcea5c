// SPDX-License-Identifier: Apache-2.0
package msq

import (
	"errors"
	"math"
	"os"
	"path/filepath"
	"runtime"
	"strings"
	"testing"
)

func foamModel(t *testing.T) (*Context, *Model) {
	t.Helper()
	context, err := NewContext(2)
	check(t, err)
	box, err := Box(context, [3]float64{}, [3]float64{8, 6, 4})
	check(t, err)
	foam, err := NewFoam(context, Foam{CellSize: [3]float64{2, 2, 2}, Radius: 0.3})
	check(t, err)
	model, err := NewModel(context, box, foam)
	check(t, err)
	return context, model
}

func check(t *testing.T, err error) {
	t.Helper()
	if err != nil {
		t.Fatal(err)
	}
}

func TestLayersComeInOrder(t *testing.T) {
	_, model := foamModel(t)
	slicer, err := model.Slicer(Plan{Pitch: 0.1, LayerHeight: 0.5})
	check(t, err)
	next, solid := uint64(2), uint64(0)
	check(t, slicer.Run(2, 5, nil, func(layer Layer) error {
		if layer.Index != next || layer.Width != 80 || len(layer.Data) != layer.Stride*60 {
			t.Errorf("layer %+v", layer)
		}
		next++
		solid += layer.InsideCount
		runtime.GC()
		return nil
	}))
	if next != 7 || solid == 0 {
		t.Errorf("next %d, solid %d", next, solid)
	}
}

func TestErrorsAndPanicsOfTheFunctionStopTheRun(t *testing.T) {
	_, model := foamModel(t)
	slicer, err := model.Slicer(Plan{Pitch: 0.5, LayerHeight: 0.5})
	check(t, err)
	enough, calls := errors.New("enough"), 0
	err = slicer.Run(0, slicer.LayerCount, nil, func(Layer) error { calls++; return enough })
	if !errors.Is(err, enough) || calls != 1 {
		t.Errorf("%v after %d calls", err, calls)
	}
	for count, want := range map[uint64]string{2: "layers 5 to 7: enough", math.MaxUint64: "layers 5 to 8: enough"} {
		err = slicer.Run(5, count, nil, func(Layer) error { return enough })
		if err == nil || err.Error() != want {
			t.Errorf("%v in place of %s", err, want)
		}
	}
	defer func() {
		if recover() != "oh" {
			t.Error("the panic was lost")
		}
	}()
	_ = slicer.Run(0, slicer.LayerCount, nil, func(Layer) error { panic("oh") })
}

func TestPanicsWithoutAValueStopTheRun(t *testing.T) {
	_, model := foamModel(t)
	slicer, err := model.Slicer(Plan{Pitch: 0.5, LayerHeight: 0.5})
	check(t, err)
	calls, returned := 0, false
	func() {
		defer func() { recover() }() // nil, or since 1.21 an error
		_ = slicer.Run(0, slicer.LayerCount, nil, func(Layer) error { calls++; panic(nil) })
		returned = true
	}()
	if calls != 1 || returned {
		t.Errorf("%d calls, returned: %v", calls, returned)
	}
	check(t, slicer.Run(0, 1, nil, func(Layer) error { return nil }))
}

func refused(t *testing.T, err error, message string) {
	t.Helper()
	var refused *Error
	if !errors.As(err, &refused) || refused.Status != ErrArgument || !strings.Contains(err.Error(), message) {
		t.Error(err)
	}
}

func TestNumbersThatDoNotFitAreRefused(t *testing.T) {
	_, err := NewContext(-1)
	refused(t, err, "threads is -1; it must be from 0 to 4294967295")
	large := int64(math.MaxUint32) + 1
	if int64(int(large)) == large { // of 64 bits
		_, err = NewContext(int(large))
		refused(t, err, "threads is 4294967296; it must be from 0 to 4294967295")
	}
}

func TestTextsWithAZeroByteAreRefused(t *testing.T) {
	context, _ := foamModel(t)
	path := filepath.Join(t.TempDir(), "a.off")
	text := "OFF\n4 4 0\n0 0 0\n6 0 0\n0 6 0\n0 0 6\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"
	check(t, os.WriteFile(path, []byte(text), 0o600))
	_, err := ShapeFromFile(context, path)
	check(t, err)
	_, err = ShapeFromFile(context, path+"\x00.png")
	refused(t, err, "has a zero byte at")
	_, err = DocumentFromJSON(context, []byte("{\"msq_model\": 1}\x00"))
	if err == nil {
		t.Error("the text was cut at its zero byte")
	}
}

func TestRefusalsHaveStatusAndMessage(t *testing.T) {
	context, _ := foamModel(t)
	_, err := Sphere(context, [3]float64{}, -1)
	refused(t, err, "-1")
}

func TestFoamsAreStretched(t *testing.T) {
	context, _ := foamModel(t)
	ball, err := Sphere(context, [3]float64{}, 4)
	check(t, err)
	points := make([][3]float64, 2000)
	for i := range points {
		for axis, step := range [3]float64{0.618034, 0.754878, 0.569840} {
			points[i][axis] = 6*math.Mod(float64(i)*step, 1) - 3
		}
	}
	inside := func(stretch [3]float64) []bool {
		foam, err := NewFoam(context, Foam{CellSize: [3]float64{2, 2, 2}, Radius: 0.3, Stretch: stretch})
		check(t, err)
		model, err := NewModel(context, ball, foam)
		check(t, err)
		found, err := model.Membership(points)
		check(t, err)
		return found
	}
	differ := func(a, b []bool) (count int) {
		for i := range a {
			if a[i] != b[i] {
				count++
			}
		}
		return
	}
	plain := inside([3]float64{})
	if count := differ(plain, inside([3]float64{2, 2, 2})); count != 0 { // only the proportions count
		t.Errorf("%d points differ", count)
	}
	if count := differ(plain, inside([3]float64{1, 1, 3})); count < 50 {
		t.Errorf("only %d points differ", count)
	}
	_, err = NewFoam(context, Foam{CellSize: [3]float64{2, 2, 2}, Radius: 0.3, Stretch: [3]float64{1, 1, 0}})
	if err == nil || !strings.Contains(err.Error(), "stretch[2] is 0") {
		t.Error(err)
	}
	_, err = NewFoam(context, Foam{CellSize: [3]float64{2, 2, 2}, Radius: 0.3, Weight: 2})
	check(t, err)
	_, err = NewFoam(context, Foam{CellSize: [3]float64{2, 2, 2}, Radius: 0.3, Weight: 2.5})
	if err == nil || !strings.Contains(err.Error(), "weight is 2.5") {
		t.Error(err)
	}
}

func TestJobsCancel(t *testing.T) {
	_, model := foamModel(t)
	slicer, err := model.Slicer(Plan{Pitch: 0.1, LayerHeight: 0.01})
	check(t, err)
	job, err := NewJob()
	check(t, err)
	check(t, job.Cancel())
	err = slicer.Run(0, slicer.LayerCount, job, func(Layer) error { return nil })
	var cancelled *Error
	if !errors.As(err, &cancelled) || cancelled.Status != ErrCancelled {
		t.Error(err)
	}
}

func TestDistanceAgreesWithMembershipInManyGoroutines(t *testing.T) {
	_, model := foamModel(t)
	points := make([][3]float64, 2000)
	for i := range points {
		points[i] = [3]float64{float64(i%20) * 0.4, float64(i/20%10) * 0.6, float64(i/200) * 0.4}
	}
	done := make(chan error)
	for n := 0; n < 8; n++ {
		go func() {
			inside, err := model.Membership(points)
			if err != nil {
				done <- err
				return
			}
			distances, err := model.Distance(points)
			for i := range inside {
				if err == nil && inside[i] != (distances[i] <= 0) {
					err = errors.New("signs differ")
				}
			}
			done <- err
		}()
	}
	for n := 0; n < 8; n++ {
		check(t, <-done)
	}
}
