// SPDX-License-Identifier: Apache-2.0

// Runs the vectors through the package: see tests/vectors/protocol.py. usage: vectors MODEL POINTS ...
package main

import (
	"bytes"
	"encoding/hex"
	"errors"
	"fmt"
	"log"
	"math"
	"os"
	"strings"
	"unsafe"

	"msq"
)

func bits(value float64) string { return fmt.Sprintf("%016x", math.Float64bits(value)) }

func printCase(document *msq.Document, points [][3]float64) error {
	title, err := document.Title()
	if err != nil {
		return err
	}
	fmt.Println("title", title)
	model, err := document.Model()
	if err != nil {
		return err
	}
	hash, err := model.Hash()
	var refused *msq.Error
	if errors.As(err, &refused) && refused.Status == msq.ErrUnsupported {
		fmt.Println("hash -")
	} else if err != nil {
		return err
	} else {
		fmt.Println("hash", hex.EncodeToString(hash[:]))
	}
	inside, err := model.Membership(points)
	if err != nil {
		return err
	}
	var digits strings.Builder
	for _, one := range inside {
		digits.WriteByte(map[bool]byte{false: '0', true: '1'}[one])
	}
	fmt.Println("inside", digits.String())
	distances, err := model.Distance(points)
	if err != nil {
		return err
	}
	fmt.Print("distance")
	for _, distance := range distances {
		fmt.Print(" ", bits(distance))
	}
	fmt.Println()
	slicer, err := document.Slicer()
	if err != nil {
		return err
	}
	fmt.Println("plan", slicer.Width, slicer.Height, slicer.LayerCount)
	return slicer.Run(0, slicer.LayerCount, nil, func(layer msq.Layer) error {
		_, err := fmt.Println("layer", layer.Index, bits(layer.Z), hex.EncodeToString(layer.Data))
		return err
	})
}

func pointsOf(data []byte) [][3]float64 {
	points := make([][3]float64, len(data)/24)
	if len(points) > 0 {
		copy(unsafe.Slice((*byte)(unsafe.Pointer(&points[0])), len(data)), data)
	}
	return points
}

func run(context *msq.Context, modelPath, pointsPath string) error {
	text, err := os.ReadFile(modelPath)
	if err != nil {
		return err
	}
	data, err := os.ReadFile(pointsPath)
	if err != nil {
		return err
	}
	document, err := msq.DocumentFromJSON(context, bytes.TrimSpace(text))
	var refused *msq.Error
	if errors.As(err, &refused) {
		fmt.Println("refused", refused)
		return nil
	}
	if err != nil {
		return err
	}
	return printCase(document, pointsOf(data))
}

func main() {
	context, err := msq.NewContext(0)
	if err != nil {
		log.Fatal(err)
	}
	for i := 1; i+1 < len(os.Args); i += 2 {
		fmt.Println("case")
		if err := run(context, os.Args[i], os.Args[i+1]); err != nil {
			log.Fatal(err)
		}
	}
}
