// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include <cstring>

#include "bindings.h"
#include "sample_class.h"

namespace trident::sim {
namespace {

using ArrayShape = std::vector<py::ssize_t>;

template <class Value>
// Copies: the next picture is drawn into the same buffer.
py::array copied(const ArrayShape& shape, const std::vector<std::uint8_t>& bytes) {
  py::array_t<Value> array(shape);
  std::memcpy(array.mutable_data(), bytes.data(), bytes.size());
  return array;
}

py::array pixels_of(const ImageSample& image) {
  const auto height = static_cast<py::ssize_t>(image.height);
  const auto width = static_cast<py::ssize_t>(image.width);
  if (image.encoding == "32FC1") return copied<float>({height, width}, image.data);
  if (image.encoding == "16UC1" || image.encoding == "mono16") {
    return copied<std::uint16_t>({height, width}, image.data);
  }
  if (image.encoding == "mono8") return copied<std::uint8_t>({height, width}, image.data);
  return copied<std::uint8_t>({height, width, 3}, image.data);
}

template <std::size_t kSize>
py::array_t<double> to_matrix(const std::array<double, kSize>& values, const ArrayShape& shape) {
  py::array_t<double> matrix(shape);
  std::copy(values.begin(), values.end(), matrix.mutable_data());
  return matrix;
}

ArrayShape shape_of(const ImageCloudSample& cloud) {
  return {static_cast<py::ssize_t>(cloud.height), static_cast<py::ssize_t>(cloud.width), 3};
}

py::array_t<float> points_of(const ImageCloudSample& cloud) {
  py::array_t<float> points(shape_of(cloud));
  float* out = points.mutable_data();
  for (const ImageCloudSample::Point& point : cloud.points) {
    *out++ = point.x;
    *out++ = point.y;
    *out++ = point.z;
  }
  return points;
}

py::array_t<std::uint8_t> colors_of(const ImageCloudSample& cloud) {
  py::array_t<std::uint8_t> colors(shape_of(cloud));
  std::uint8_t* out = colors.mutable_data();
  for (const ImageCloudSample::Point& point : cloud.points) {
    // The packed color is 0x00RRGGBB.
    for (const int shift : {16, 8, 0}) *out++ = static_cast<std::uint8_t>(point.rgb >> shift);
  }
  return colors;
}

void bind_images(py::module_& module) {
  stamped<ImageSample>(module, "ImageSample", "A picture; stamp: when it was taken.")
      .def_readonly("frame", &ImageSample::frame, "Optical frame: x right, y down, z ahead.")
      .def_readonly("encoding", &ImageSample::encoding,
                    "rgb8, bgr8, mono8, mono16, 16UC1 or 32FC1, as ROS names them.")
      .def_property_readonly("pixels", pixels_of,
                             "Shape (height, width, 3), uint8, of colors; else "
                             "(height, width): m, mm or labels.");
  stamped<ImageCloudSample>(module, "ImageCloudSample", "Points of a picture, pixel by pixel.")
      .def_readonly("frame", &ImageCloudSample::frame, "Optical frame: x right, y down, z ahead.")
      .def_property_readonly("points", points_of,
                             "[m], shape (height, width, 3), float32; nan: nothing is seen there.")
      .def_property_readonly("colors", colors_of,
                             "Red, green, blue, shape (height, width, 3), uint8.");
}

void bind_camera_info(py::module_& module) {
  using Info = CameraInfoSample;
  stamped<Info>(module, "CameraInfoSample", "A pinhole camera, as sensor_msgs/CameraInfo has it.")
      .def_readonly("frame", &Info::frame, "Optical frame: x right, y down, z ahead.")
      .def_readonly("width", &Info::width, "[pixels].")
      .def_readonly("height", &Info::height, "[pixels].")
      .def_property_readonly(
          "d", [](const Info& s) { return to_matrix(s.D, {5}); },
          "Distortion (plumb_bob): k1 k2 t1 t2 k3, shape (5,).")
      .def_property_readonly(
          "k",
          [](const Info& s) {
            return to_matrix(s.K, {3, 3});
          },
          "Focal lengths and middle of the raw picture [pixels], shape (3, 3).")
      .def_property_readonly(
          "r",
          [](const Info& s) {
            return to_matrix(s.R, {3, 3});
          },
          "Rotation that rectifies, shape (3, 3).")
      .def_property_readonly(
          "p",
          [](const Info& s) {
            return to_matrix(s.P, {3, 4});
          },
          "Projection of the rectified picture [pixels], shape (3, 4).");
}

void bind_boxes(py::module_& module) {
  using Box = BoundingBoxesSample::Box;
  py::class_<Box> box(module, "BoundingBox", "What a camera sees of one model or link.");
  box.attr("__module__") = "trident_sim";
  box.def_readonly("label", &Box::label, "Of its pixels in the segmentation picture.")
      .def_readonly("name", &Box::name, "Model, or model::link.")
      .def_readonly("x_min", &Box::x_min, "Leftmost pixel.")
      .def_readonly("y_min", &Box::y_min, "Topmost pixel.")
      .def_readonly("x_max", &Box::x_max, "Rightmost pixel.")
      .def_readonly("y_max", &Box::y_max, "Lowest pixel.")
      .def_readonly("pixels", &Box::pixels, "How many show it.");
  stamped<BoundingBoxesSample>(module, "BoundingBoxesSample", "What a camera sees, by label.")
      .def_readonly("frame", &BoundingBoxesSample::frame, "Optical frame of the camera.")
      .def_readonly("boxes", &BoundingBoxesSample::boxes, "One per model or link that is seen.");
}

}  // namespace

void bind_cameras(py::module_& module) {
  bind_images(module);
  bind_camera_info(module);
  bind_boxes(module);
}

}  // namespace trident::sim
