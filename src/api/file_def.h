// SPDX-License-Identifier: Apache-2.0
// How files are read, for functions that read meshes or beams.
#pragma once

#include "api/guard.h"
#include "io/mesh_file.h"
#include "shape/mesh.h"

namespace msq::api {

msq_file_def file_defaults();

WindingRule winding_rule(int32_t rule);

/// The definition of a mesh that keeps its arrays itself.
msq_mesh_def mesh_def(WindingRule rule);

struct FileRequest {
  MeshFileOptions options;
  WindingRule rule;
};

/// The host's wishes, checked; def NULL: the defaults. The budget is the context's.
FileRequest file_request(const msq_file_def* def, const Context& owner);

}  // namespace msq::api
