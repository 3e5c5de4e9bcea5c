// SPDX-License-Identifier: Apache-2.0
//! Model files: models in JSON, with settings for slices and pictures.
use std::ffi::{CStr, CString};
use std::path::Path;
use std::ptr;

use crate::context::{raw_job, Context, Job};
use crate::model::Model;
use crate::slicer::Slicer;
use crate::{sys, Error, Result};

handle!(
    /// A model with settings for slices and pictures, read from JSON.
    Document, msq_document, msq_document_retain, msq_document_release
);

impl Document {
    /// Reads a text. It may name no files by relative paths: there is no folder that they start in.
    pub fn from_json(context: &Context, text: &str, job: Option<&Job>) -> Result<Document> {
        Document::make(|raw| unsafe {
            sys::msq_document_from_json(
                context.as_ptr(),
                text.as_ptr() as *const _,
                text.len() as u64,
                ptr::null(),
                raw,
                raw_job(job),
            )
        })
    }

    /// Reads a file, whose folder is where the paths in it start.
    pub fn from_file(
        context: &Context,
        path: impl AsRef<Path>,
        job: Option<&Job>,
    ) -> Result<Document> {
        let path = path.as_ref();
        let text = path.to_str().and_then(|text| CString::new(text).ok()).ok_or_else(|| {
            Error::argument(format!("the path {path:?} is not UTF-8, or has a zero byte"))
        })?;
        Document::make(|raw| unsafe {
            sys::msq_document_from_file(
                context.as_ptr(),
                text.as_ptr(),
                ptr::null(),
                raw,
                raw_job(job),
            )
        })
    }

    /// "" if there is none.
    pub fn title(&self) -> Result<String> {
        let info = report!(msq_document_report, |r| sys::msq_document_info(self.as_ptr(), r));
        Ok(unsafe { CStr::from_ptr(info.title) }.to_string_lossy().into_owned())
    }

    pub fn model(&self) -> Result<Model> {
        Model::make(|raw| unsafe { sys::msq_document_model(self.as_ptr(), raw) })
    }

    /// The layers that the settings for slices describe.
    pub fn slicer(&self) -> Result<Slicer> {
        let model = self.model()?;
        let mut def = definition!(msq_slicer_def_init, msq_slicer_def);
        crate::check(unsafe { sys::msq_document_slicing(self.as_ptr(), &mut def) })?;
        Slicer::make(|raw| unsafe { sys::msq_slicer_create(model.as_ptr(), &def, raw) })
    }
}
