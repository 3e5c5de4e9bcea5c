// SPDX-License-Identifier: Apache-2.0

// Slices a box filled with a foam, and prints the share of solid pixels of each fifth layer.
package main

import (
	"fmt"
	"log"

	"msq"
)

func run() error {
	context, err := msq.NewContext(0)
	if err != nil {
		return err
	}
	box, err := msq.Box(context, [3]float64{}, [3]float64{20, 20, 10})
	if err != nil {
		return err
	}
	foam, err := msq.NewFoam(context, msq.Foam{CellSize: [3]float64{2, 2, 2}, Radius: 0.2})
	if err != nil {
		return err
	}
	model, err := msq.NewModel(context, box, foam)
	if err != nil {
		return err
	}
	slicer, err := model.Slicer(msq.Plan{Pitch: 0.05, LayerHeight: 0.5})
	if err != nil {
		return err
	}
	return slicer.Run(0, slicer.LayerCount, nil, func(layer msq.Layer) error {
		if layer.Index%5 == 0 {
			share := 100 * float64(layer.InsideCount) / float64(layer.Width*layer.Height)
			fmt.Printf("z = %g: %.1f %% solid\n", layer.Z, share)
		}
		return nil
	})
}

func main() {
	if err := run(); err != nil {
		log.Fatal(err)
	}
}
