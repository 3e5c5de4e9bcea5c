// SPDX-License-Identifier: Apache-2.0
using System;
using System.Text;
using System.Threading;
using Msq.Interop;

namespace Msq
{
    /// <summary>A model with settings for slices, from JSON (docs/model_file.md).</summary>
    public sealed unsafe class Document : Handle
    {
        private Document(msq_document* made) : base(made) { }

        /// <summary>files: which files the text may name, below the base directory or anywhere.</summary>
        public static Document FromJson(Context context, string text, string baseDirectory = null,
                                        DocumentFiles files = DocumentFiles.Below,
                                        CancellationToken cancel = default(CancellationToken),
                                        IProgress<double> progress = null)
        {
            if (text == null) throw new ArgumentNullException(nameof(text));
            msq_document_def def = msq_document_def.Defaults();
            def.files = (int)files;
            msq_document* made;
            using (var call = new Call(cancel, progress))
            {
                def.base_directory = call.Text(baseDirectory, nameof(baseDirectory));
                // With a 0 behind it, so that there is an address for no bytes, too.
                byte[] bytes = Encoding.UTF8.GetBytes(text + "\0");
                call.Check(Abi.msq_document_from_json(call.Use(context), (byte*)call.Pin(bytes),
                                                      (ulong)(bytes.Length - 1), &def, &made,
                                                      call.Job));
                return call.Done(new Document(made));
            }
        }

        public static Document FromFile(Context context, string path, DocumentFiles files = DocumentFiles.Below,
                                        CancellationToken cancel = default(CancellationToken),
                                        IProgress<double> progress = null)
        {
            if (path == null) throw new ArgumentNullException(nameof(path));
            msq_document_def def = msq_document_def.Defaults();
            def.files = (int)files;
            msq_document* made;
            using (var call = new Call(cancel, progress))
            {
                call.Check(Abi.msq_document_from_file(call.Use(context), call.Text(path, nameof(path)), &def, &made,
                                                      call.Job));
                return call.Done(new Document(made));
            }
        }

        private msq_document* In(Call call) => (msq_document*)call.Use(this, "document");

        public string Title
        {
            get
            {
                var report = new msq_document_report { struct_size = (uint)sizeof(msq_document_report) };
                using (var call = new Call())
                {
                    call.Check(Abi.msq_document_info(In(call), &report));
                    return Abi.Text(report.title);
                }
            }
        }

        public Model Model()
        {
            msq_model* made;
            using (var call = new Call()) call.Check(Abi.msq_document_model(In(call), &made));
            return new Model(made);
        }

        /// <summary>The layers of the settings for slices.</summary>
        public Slicer Slicer()
        {
            msq_slicer_def def = msq_slicer_def.Defaults();
            using (var call = new Call())
            {
                msq_document* document = In(call);
                MsqException.Check(Abi.msq_document_slicing(document, &def));
                using (Model model = Model()) return new Slicer(model, &def);
            }
        }

        protected override bool ReleaseHandle()
        {
            Abi.msq_document_release((msq_document*)handle);
            return true;
        }
    }
}
