// SPDX-License-Identifier: Apache-2.0
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;
using System.Threading;
using Msq.Interop;

namespace Msq
{
    /// <summary>How a model is cut into layers.</summary>
    public sealed class SlicerOptions
    {
        /// <summary>pitch: size of a pixel.</summary>
        public SlicerOptions(double pitch, double layerHeight)
        {
            PitchX = PitchY = pitch;
            LayerHeight = layerHeight;
        }

        public double PitchX { get; set; }
        public double PitchY { get; set; }
        public double LayerHeight { get; set; }
        /// <summary>What a layer holds: of the kinds with pixels.</summary>
        public LayerOutput Output { get; set; } = LayerOutput.Bits;
        /// <summary>A sum of mirrors and TRANSPOSE.</summary>
        public LayerOrientation Orientation { get; set; }
        /// <summary>Grey: samples along each side of a pixel: 2, 4, 8 or 16.</summary>
        public int GreySamples { get; set; } = 4;
        /// <summary>Finer scales than this are left out.</summary>
        public double LengthScale { get; set; }
        /// <summary>Heights of the layers, in place of the layer height; null: even ones.</summary>
        public double[] Heights { get; set; }
        /// <summary>Corners of the region; null: the bounding box of the model.</summary>
        public Vec3[] Region { get; set; }
    }

    /// <summary>A layer, in memory of its own.</summary>
    public sealed class Layer
    {
        internal Layer(long index, double z, LayerOutput output, int width, int height, int stride, byte[] data)
        {
            Index = index;
            Z = z;
            Output = output;
            Width = width;
            Height = height;
            Stride = stride;
            Data = data;
        }

        public long Index { get; }
        public double Z { get; }
        public LayerOutput Output { get; }
        public int Width { get; }
        public int Height { get; }
        /// <summary>Bytes from one row to the next.</summary>
        public int Stride { get; }
        /// <summary>Height rows, row 0 at the smallest y.</summary>
        public byte[] Data { get; }

        /// <summary>Whether a pixel of bits or bytes is solid.</summary>
        public bool IsInside(int x, int y)
        {
            if (x < 0 || x >= Width || y < 0 || y >= Height)
                throw new ArgumentOutOfRangeException("pixel (" + x + ", " + y + ") is not in " + Width + " x " + Height);
            if (Output == LayerOutput.Bits) return (Data[y * Stride + x / 8] & (0x80 >> (x % 8))) != 0;
            if (Output == LayerOutput.Bytes) return Data[y * Stride + x] != 0;
            throw new InvalidOperationException("a layer of " + Output + " has no bits");
        }
    }

    /// <summary>A layer in memory of msq, until the callback returns.</summary>
    public sealed unsafe class LayerView
    {
        private msq_layer* layer;

        internal LayerView(msq_layer* layer) { this.layer = layer; }
        internal void Close() { layer = null; }

        private msq_layer* Open =>
            layer != null ? layer : throw new ObjectDisposedException(nameof(LayerView), "the callback has returned");

        public long Index => (long)Open->index;
        public double Z => Open->z;
        public LayerOutput Output => (LayerOutput)Open->output;
        public int Width => (int)Open->width;
        public int Height => (int)Open->height;
        /// <summary>Bytes from one row to the next.</summary>
        public int Stride => checked((int)Open->stride);
        /// <summary>Number of solid samples.</summary>
        public long InsideCount => (long)Open->inside_count;
        /// <summary>Stride * Height bytes. Contours: null.</summary>
        public IntPtr Pointer => (IntPtr)Open->data;

#if MSQ_SPAN || NETCOREAPP2_1_OR_GREATER || NETSTANDARD2_1_OR_GREATER
        /// <summary>Height rows, row 0 at the smallest y.</summary>
        public ReadOnlySpan<byte> Data => new ReadOnlySpan<byte>(Open->data, checked(Stride * Height));
#endif

        /// <summary>Copies the bytes to the beginning of an array.</summary>
        public void CopyTo(byte[] target)
        {
            if (target == null) throw new ArgumentNullException(nameof(target));
            int bytes = checked(Stride * Height);
            if (bytes > 0) Marshal.Copy(Pointer, target, 0, bytes); // contours: null
        }

        /// <summary>The layer in memory of its own.</summary>
        public Layer Copy()
        {
            var data = new byte[checked(Stride * Height)];
            CopyTo(data);
            return new Layer(Index, Z, Output, Width, Height, Stride, data);
        }
    }

    /// <summary>Layers of a model.</summary>
    public sealed unsafe class Slicer : Handle
    {
        private msq_slicer_report info;
        private readonly LayerOutput output;

        public Slicer(Model model, SlicerOptions options) : base(Create(model, options))
        {
            output = options.Output;
            ReadInfo();
        }

        /// <summary>By a definition of msq.h. Its pointers must be valid until this returns.</summary>
        public Slicer(Model model, msq_slicer_def* def) : base(Create(model, def))
        {
            output = (LayerOutput)(def->output_count > 0 ? def->outputs[0].output : def->output);
            ReadInfo();
        }

        private static msq_slicer* Create(Model model, SlicerOptions options)
        {
            if (options == null) throw new ArgumentNullException(nameof(options));
            msq_slicer_def def = msq_slicer_def.Defaults();
            def.pitch[0] = options.PitchX;
            def.pitch[1] = options.PitchY;
            def.layer_height = options.LayerHeight;
            def.output = (int)options.Output;
            def.orientation = (uint)options.Orientation;
            def.grey_samples = Call.Unsigned(options.GreySamples, nameof(options.GreySamples));
            def.length_scale = options.LengthScale;
            def.layer_z_count = (ulong)(options.Heights?.Length ?? 0);
            if (options.Region != null)
            {
                if (options.Region.Length != 2)
                    throw new ArgumentException("Region has " + options.Region.Length + " corners; it must have 2",
                                                nameof(options));
                def.has_region = 1;
                *(Vec3*)def.region_min = options.Region[0];
                *(Vec3*)def.region_max = options.Region[1];
            }
            using (var call = new Call())
            {
                def.layer_z = (double*)call.Pin(options.Heights);
                return Create(model, &def);
            }
        }

        private static msq_slicer* Create(Model model, msq_slicer_def* def)
        {
            if (model == null) throw new ArgumentNullException(nameof(model));
            if (def == null) throw new ArgumentNullException(nameof(def));
            msq_slicer* made;
            using (var call = new Call()) call.Check(Abi.msq_slicer_create(model.In(call), def, &made));
            return made;
        }

        private void ReadInfo()
        {
            var report = new msq_slicer_report { struct_size = (uint)sizeof(msq_slicer_report) };
            using (var call = new Call()) call.Check(Abi.msq_slicer_info(In(call), &report));
            info = report;
        }

        internal msq_slicer* In(Call call) => (msq_slicer*)call.Use(this, "slicer");

        public int Width => (int)info.width;
        public int Height => (int)info.height;
        public long LayerCount => (long)info.layer_count;
        /// <summary>Bytes from one row to the next.</summary>
        public int Stride => checked((int)info.stride);
        /// <summary>What the layers hold.</summary>
        public LayerOutput Output => output;

        /// <summary>The centre of pixel (0, 0).</summary>
        public Vec2 Origin
        {
            get
            {
                msq_slicer_report report = info;
                return new Vec2(report.origin[0] + report.window.first[0] * report.pitch[0],
                                report.origin[1] + report.window.first[1] * report.pitch[1]);
            }
        }

        /// <summary>z of a layer.</summary>
        public double Z(long index)
        {
            double z;
            using (var call = new Call())
                call.Check(Abi.msq_slicer_layer_z(In(call), Call.Unsigned(index, nameof(index)), &z));
            return z;
        }

        /// <summary>Passes all layers to a function, in order, on this thread. What it throws stops the run
        /// and comes out of it.</summary>
        public void Run(Action<LayerView> take, CancellationToken cancel = default(CancellationToken),
                        IProgress<double> progress = null)
        {
            Run(0, LayerCount, take, cancel, progress);
        }

        /// <summary>Passes count layers to a function, from the first on.</summary>
        public void Run(long first, long count, Action<LayerView> take,
                        CancellationToken cancel = default(CancellationToken), IProgress<double> progress = null)
        {
            if (take == null) throw new ArgumentNullException(nameof(take));
            using (var call = new Call(cancel, progress))
            {
                call.Check(Abi.msq_slicer_run(In(call), Call.Unsigned(first, nameof(first)),
                                              Call.Unsigned(count, nameof(count)), Callbacks.Layer,
                                              call.User(take), call.Job));
                call.Done(count);
            }
        }

        /// <summary>One layer, from any thread.</summary>
        public Layer Layer(long index, CancellationToken cancel = default(CancellationToken))
        {
            double z = Z(index);
            var data = new byte[checked((int)info.layer_bytes)];
            fixed (byte* buffer = data)
            using (var call = new Call(cancel, null))
                call.Check(Abi.msq_slice_layer(In(call), Call.Unsigned(index, nameof(index)), buffer,
                                               (ulong)data.Length, call.Job));
            return new Layer(index, z, output, Width, Height, Stride, data);
        }

        /// <summary>All layers in order, each computed when it is reached; msq fills those that follow
        /// together.</summary>
        public IEnumerable<Layer> Layers(CancellationToken cancel = default(CancellationToken))
        {
            for (long index = 0; index < LayerCount; ++index) yield return Layer(index, cancel);
        }

        /// <summary>The contours of a layer, from any thread.</summary>
        public Contours Contours(long index, ContoursOptions options,
                                 CancellationToken cancel = default(CancellationToken))
        {
            if (options == null) throw new ArgumentNullException(nameof(options));
            msq_contours_def def = options.Raw();
            msq_contours* made;
            using (var call = new Call(cancel, null))
                call.Check(Abi.msq_slicer_contours(In(call), Call.Unsigned(index, nameof(index)), &def, &made,
                                                   call.Job));
            return new Contours(made);
        }

        protected override bool ReleaseHandle()
        {
            Abi.msq_slicer_release((msq_slicer*)handle);
            return true;
        }
    }
}
