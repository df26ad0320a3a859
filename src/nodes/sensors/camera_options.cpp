// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/sensors/camera_options.h"

namespace vegetation_sim {

void describe(FieldVisitor& v, CameraOptions& o) {
  v.integer("rate", o.rate, "Hz", {1, 100});
  describe(v, static_cast<SensorOptions&>(o));
  describe(v, o.lens);
  describe(v, o.camera);
}

CameraOptions loadCameraOptions(const ros::NodeHandle& private_handle) {
  CameraOptions out;
  Parameters parameters(private_handle);
  readNames(parameters, out);
  parameters.frame("camera_frame", out.camera_frame);
  parameters.text("camera_info_url", out.camera_info_url);
  describe(parameters, out);
  out.camera.lens = scan::lensOf(out.lens);
  if (parameters.faults().empty())
    scan::check(out.camera, private_handle.getNamespace() + "/", parameters.faults());
  parameters.finish();
  return out;
}

}  // namespace vegetation_sim
