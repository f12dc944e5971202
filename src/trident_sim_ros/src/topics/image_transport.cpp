// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "image_transport.h"

#include <sensor_msgs/CompressedImage.h>

#include "conversions/conversions.h"
#include "trident_base/error.h"
#include "trident_sim/image_codec.h"

namespace trident::sim {
namespace {

template <class Number>
void read_number(const std::string& name, Number low, Number high, Number& value) {
  Number given = value;
  if (!ros::param::get(name, given)) return;
  if (given >= low && given <= high) {
    value = given;
    return;
  }
  ROS_ERROR_STREAM("parameter " << name << " is " << given << ", legal: " << low << " to " << high
                                << "; " << value << " counts");
}

PictureCompression read_picture_compression(const std::string& topic) {
  PictureCompression how;
  std::string format = "jpeg";
  ros::param::get(topic + "/format", format);
  how.as_png = format == "png";
  if (!how.as_png && format != "jpeg") {
    ROS_ERROR_STREAM("parameter " << topic << "/format is '" << format
                                  << "', legal: jpeg or png; jpeg counts");
  }
  read_number(topic + "/jpeg_quality", 1, 100, how.jpeg_quality);
  read_number(topic + "/png_level", 1, 9, how.png_level);
  return how;
}

DepthCompression read_depth_compression(const std::string& topic) {
  DepthCompression how;
  // The limits of compressed_depth_image_transport's reconfiguration.
  read_number(topic + "/depth_max", 1.0, 100.0, how.max_m);
  read_number(topic + "/depth_quantization", 1.0, 150.0, how.quantization);
  read_number(topic + "/png_level", 1, 9, how.png_level);
  return how;
}

class CompressedBinding : public OutputBinding {
 public:
  CompressedBinding(TopicAdvertiser& advertiser, OutPort<ImageSample>& port)
      : OutputBinding(port),
        port_(port),
        topic_("/" + port.name() + "/" + compressed_name(port.value)),
        publisher_(advertiser.advertise<sensor_msgs::CompressedImage>(topic_, large_topic())) {}

  void publish() override {
    if (!has_read_parameters_) read_parameters();
    sensor_msgs::CompressedImage message;
    if (is_depth_encoding(port_.value.encoding)) {
      compress_depth(port_.value, depth_compression_, picture_);
    } else {
      compress_picture(port_.value, picture_compression_, picture_);
    }
    message.header.stamp = to_ros(port_.value.stamp);
    message.header.frame_id = port_.value.frame;
    message.format = picture_.format;
    message.data = picture_.data;
    publisher_.publish(message);
  }
  std::unique_ptr<ros_utils::DirectMessage> message() override { return nullptr; }
  std::uint32_t subscribers() const override { return publisher_.getNumSubscribers(); }
  const ros::Publisher& publisher() const override { return publisher_; }

 private:
  void read_parameters() {
    has_read_parameters_ = true;
    picture_compression_ = read_picture_compression(topic_);
    depth_compression_ = read_depth_compression(topic_);
  }

  OutPort<ImageSample>& port_;
  std::string topic_;
  ros::Publisher publisher_;
  bool has_read_parameters_ = false;
  PictureCompression picture_compression_;
  DepthCompression depth_compression_;
  CompressedPicture picture_;
};

}  // namespace

std::string compressed_name(const ImageSample& image) {
  return is_depth_encoding(image.encoding) ? "compressedDepth" : "compressed";
}

std::unique_ptr<OutputBinding> bind_compressed(TopicAdvertiser& advertiser,
                                               OutPort<ImageSample>& port) {
  return std::make_unique<CompressedBinding>(advertiser, port);
}

}  // namespace trident::sim
