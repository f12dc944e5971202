// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "plugin_cases.h"

namespace trident::sim {
namespace {

const ParamList kBase{{"robotNamespace", "ns"}, {"linkName", "base_link"}};

std::vector<PluginCase> model_cases() {
  return {
      {"librotors_gazebo_motor_model.so",
       motor_params({}, 1),
       {"jointName", "linkName", "motorNumber", "turningDirection"},
       {"motorNumber", "timeConstantUp", "timeConstantDown", "maxRotVelocity", "motorConstant",
        "momentConstant", "rotorDragCoefficient", "rollingMomentCoefficient",
        "rotorVelocitySlowdownSim"}},
      {"librotors_gazebo_multirotor_base_plugin.so",
       kBase,
       {"linkName"},
       {"rotorVelocitySlowdownSim"}},
      {"librotors_gazebo_controller_interface.so", kBase, {}, {}},
      {"librotors_gazebo_odometry_plugin.so",
       {{"robotNamespace", "ns"},
        {"linkName", "base_link"},
        {"measurementDelay", "2"},
        {"noiseNormalPosition", "0.1 0.1 0.1"}},
       {"linkName"},
       {"measurementDivisor", "measurementDelay", "unknownDelay", "noiseNormalPosition",
        "noiseUniformAngularVelocity"}},
      {"librotors_gazebo_imu_plugin.so",
       kBase,
       {"linkName"},
       {"gyroscopeNoiseDensity", "gyroscopeRandomWalk", "gyroscopeBiasCorrelationTime",
        "gyroscopeTurnOnBiasSigma", "accelerometerNoiseDensity", "accelerometerRandomWalk",
        "accelerometerBiasCorrelationTime", "accelerometerTurnOnBiasSigma"}},
      {"libtrident_joint_drive.so",
       {{"robotNamespace", "ns"},
        {"jointName", "rotor_1_joint"},
        {"mode", "position"},
        {"target", "0.3"},
        {"p", "2e-3"},
        {"i", "1e-3"},
        {"d", "1e-4"}},
       {"jointName", "mode"},
       {"axis", "target", "p", "i", "d", "integralLimit", "effortLimit"}},
      {"libgazebo_ros_diff_drive.so",
       {{"robotNamespace", "ns"},
        {"leftJoint", "rotor_1_joint"},
        {"rightJoint", "rotor_3_joint"},
        {"odometrySource", "encoder"},
        {"publishWheelJointState", "true"},
        {"publishWheelTF", "true"}},
       {},
       {"wheelSeparation", "wheelDiameter", "wheelAcceleration", "wheelTorque", "updateRate",
        "encoderErrorPerMeter"}},
      {"libgazebo_ros_skid_steer_drive.so",
       {{"robotNamespace", "ns"},
        {"leftFrontJoint", "rotor_0_joint"},
        {"leftRearJoint", "rotor_1_joint"},
        {"rightFrontJoint", "rotor_2_joint"},
        {"rightRearJoint", "rotor_3_joint"}},
       {},
       {"wheelSeparation", "wheelDiameter", "torque", "updateRate", "covariance_x", "covariance_y",
        "covariance_yaw"}},
      {"libgazebo_ros_tricycle_drive.so",
       {{"robotNamespace", "ns"},
        {"steeringJoint", "rotor_0_joint"},
        {"actuatedWheelJoint", "rotor_2_joint"},
        {"encoderWheelLeftJoint", "rotor_1_joint"},
        {"encoderWheelRightJoint", "rotor_3_joint"}},
       {},
       {"actuatedWheelDiameter", "encoderWheelDiameter", "encoderWheelSeparation", "wheelTorque",
        "wheelAcceleration", "steeringSpeed", "steeringAngleTolerance", "updateRate"}},
      {"libgazebo_ros_kobuki.so",
       {{"robotNamespace", "ns"},
        {"left_wheel_joint_name", "rotor_1_joint"},
        {"right_wheel_joint_name", "rotor_3_joint"},
        {"publish_tf", "1"}},
       {},
       {"wheel_separation", "wheel_diameter", "torque", "velocity_command_timeout"}},
      {"libgazebo_ros_ackermann_drive.so",
       {{"robotNamespace", "ns"},
        {"front_left_joint", "rotor_1_joint"},
        {"front_right_joint", "rotor_0_joint"},
        {"left_steering_joint", "rotor_1_joint"},
        {"right_steering_joint", "rotor_0_joint"},
        {"rear_left_joint", "rotor_2_joint"},
        {"rear_right_joint", "rotor_3_joint"},
        {"wheel_radius", "0.1"},
        {"linear_velocity_pid_gain", "1e-3 1e-3 0"},
        {"odometry_source", "encoder"},
        {"publish_odom", "true"},
        {"publish_odom_tf", "true"},
        {"publish_distance", "true"}},
       {},
       {"wheel_radius", "wheel_base", "track_width", "max_steer", "max_speed", "max_steering_angle",
        "update_rate", "covariance_x", "covariance_yaw", "drive_torque", "acceleration",
        "steering_speed", "encoder_error_per_meter"}},
      {"libgazebo_ros_planar_move.so",
       {{"robotNamespace", "ns"}, {"odometryRate", "100"}},
       {},
       {"odometryRate", "cmdTimeout"}},
      {"libgazebo_ros_joint_state_publisher.so",
       {{"robotNamespace", "ns"}, {"jointName", "rotor_0_joint, rotor_1_joint"}},
       {"jointName"},
       {"updateRate"}},
      {"libtrident_wheel_encoder.so",
       {{"robotNamespace", "ns"}, {"jointName", "rotor_0_joint, rotor_1_joint"}},
       {"jointName"},
       {"ticksPerTurn", "updateRate"}},
      {"libgazebo_ros_p3d.so",
       {{"robotNamespace", "ns"},
        {"bodyName", "base_link"},
        {"topicName", "truth"},
        {"gaussianNoise", "0.1"}},
       {"bodyName", "topicName"},
       {"gaussianNoise", "updateRate", "xyzOffset", "rpyOffset"}},
      {"librotors_gazebo_wind_plugin.so",
       {{"robotNamespace", "ns"},
        {"linkName", "base_link"},
        {"windForceMean", "2"},
        {"windGustStart", "0.05"},
        {"windGustDuration", "0.05"},
        {"windGustForceMean", "3"}},
       {"linkName"},
       {"windForceMean", "windGustStart", "windGustDuration", "windGustForceMean", "windSpeedMean",
        "xyzOffset", "windDirection"}},
      {"libtrident_vessel.so",
       {{"robotNamespace", "ns"},
        {"bodyName", "base_link"},
        {"vessel", TRIDENT_REPOSITORY "/src/trident_sim/test/marine/quad_boat.yaml"}},
       {"bodyName", "vessel"},
       {"cmdTimeout", "xyzOffset"}},
      {"libtrident_anemometer.so",
       {{"robotNamespace", "ns"}, {"linkName", "base_link"}, {"gaussianNoise", "0.1"}},
       {"linkName"},
       {"gaussianNoise", "bias", "updateRate"}},
      {"libtrident_propeller.so",
       {{"robotNamespace", "ns"}, {"jointName", "rotor_1_joint"}, {"thruster", "left"}},
       {"jointName", "thruster"},
       {"maxRate", "maxThrust", "updateRate"}},
      {"librotors_gazebo_magnetometer_plugin.so",
       {{"robotNamespace", "ns"}, {"linkName", "base_link"}, {"noiseNormal", "1e-7 1e-7 1e-7"}},
       {"linkName"},
       {"refMagNorth", "refMagEast", "refMagDown", "noiseNormal", "noiseUniformInitialBias"}},
      {"librotors_gazebo_pressure_plugin.so",
       {{"robotNamespace", "ns"}, {"linkName", "base_link"}, {"pressureVariance", "4"}},
       {"linkName"},
       {"referenceAltitude", "pressureVariance"}},
      {"libgazebo_ros_imu.so",
       {{"robotNamespace", "ns"}, {"bodyName", "base_link"}, {"gaussianNoise", "0.1"}},
       {"bodyName"},
       {"gaussianNoise", "updateRate", "xyzOffset", "rpyOffset"}},
      {"libhector_gazebo_ros_gps.so",
       {{"robotNamespace", "ns"},
        {"updateRate", "50"},
        {"drift", "5 5 5"},
        {"velocityGaussianNoise", "0.1"}},
       {},
       {"referenceLatitude", "referenceHeading", "gaussianNoise", "drift", "velocityOffset"}},
      {"libhector_gazebo_ros_magnetic.so",
       {{"robotNamespace", "ns"}, {"gaussianNoise", "1e-3 1e-3 1e-3"}},
       {},
       {"magnitude", "declination", "inclination", "referenceHeading", "offset"}},
      {"libhector_gazebo_ros_baro.so",
       {{"robotNamespace", "ns"}, {"drift", "0.1"}, {"gaussianNoise", "0.5"}},
       {},
       {"updateRate", "driftFrequency"}},
      {"libhector_gazebo_ros_imu.so",
       {{"robotNamespace", "ns"},
        {"bodyName", "base_link"},
        {"rateDrift", "0.01 0.02 0.03"},
        {"accelGaussianNoise", "0.1"}},
       {},
       {"gaussianNoise", "updateRate", "rpyOffset", "rateDrift", "accelOffset",
        "headingGaussianNoise", "rateDriftFrequency"}},
  };
}

SensorSpec sensor_of(const std::string& type) {
  SensorSpec sensor;
  sensor.type = type;
  sensor.update_rate_hz = 50.0;
  sensor.params.name = "sensor";
  return sensor;
}

/// Looks down at the rotors.
SensorSpec lidar() {
  SensorSpec sensor = sensor_of("ray");
  sensor.T_link_sensor = SE3::from_xyz_rpy({0, 0, 0.5}, 0, 1.2, 0);
  const auto element = [](const char* name, std::vector<ParamNode> children) {
    return ParamNode{name, "", {}, std::move(children)};
  };
  const auto text = [](const char* name, const char* value) {
    return ParamNode{name, value, {}, {}};
  };
  sensor.params.children = {element(
      "ray",
      {element("scan", {element("horizontal", {text("samples", "20"), text("min_angle", "-1"),
                                               text("max_angle", "1")})}),
       element("range", {text("min", "0.1"), text("max", "20")}),
       element("noise", {text("type", "gaussian"), text("stddev", "0.01")})})};
  return sensor;
}

/// Looks down at the rotors.
SensorSpec camera() {
  SensorSpec sensor = sensor_of("camera");
  sensor.T_link_sensor = SE3::from_xyz_rpy({0, 0, 0.5}, 0, 1.2, 0);
  const auto text = [](const char* name, const char* value) {
    return ParamNode{name, value, {}, {}};
  };
  sensor.params.children = {
      {"camera",
       "",
       {},
       {{"image", "", {}, {text("width", "16"), text("height", "10")}},
        {"noise", "", {}, {text("type", "gaussian"), text("stddev", "0.05")}}}}};
  return sensor;
}

const std::vector<std::string> kCameraNumbers{"updateRate", "focalLength",  "Cx",
                                              "CxPrime",    "distortionK1", "distortionT2"};

std::vector<PluginCase> camera_cases() {
  const ParamList params{{"robotNamespace", "ns"}, {"cameraName", "eye"}, {"updateRate", "50"}};
  std::vector<std::string> depth_numbers = kCameraNumbers;
  depth_numbers.insert(depth_numbers.end(), {"hackBaseline", "pointCloudCutoff"});
  return {{"libgazebo_ros_camera.so", params, {}, kCameraNumbers, camera()},
          {"libgazebo_ros_depth_camera.so", params, {}, depth_numbers, camera()},
          {"libgazebo_ros_openni_kinect.so", params, {}, depth_numbers, camera()},
          {"libgazebo_ros_multicamera.so", params, {}, kCameraNumbers, camera()},
          {"libgazebo_ros_triggered_camera.so", params, {}, kCameraNumbers, camera()},
          {"libgazebo_ros_triggered_multicamera.so", params, {}, kCameraNumbers, camera()},
          {"librotors_gazebo_noisydepth_plugin.so",
           params,
           {},
           {"updateRate", "depthNoiseMinDist", "baseline", "D435MaxStdev"},
           camera()},
          {"libtrident_camera.so", params, {}, kCameraNumbers, camera()}};
}

SensorSpec bumper() {
  SensorSpec sensor = sensor_of("contact");
  const ParamNode collision{"collision", make_collision(SphereShape{0.05}).name, {}, {}};
  sensor.params.children = {ParamNode{"contact", "", {}, {collision}}};
  return sensor;
}

std::vector<PluginCase> sensor_cases() {
  return {
      {"libgazebo_ros_laser.so",
       {{"robotNamespace", "ns"}, {"topicName", "scan"}},
       {},
       {},
       lidar()},
      {"libgazebo_ros_gpu_laser.so",
       {{"robotNamespace", "ns"}, {"topicName", "scan"}},
       {},
       {},
       lidar()},
      {"libtrident_lidar.so", {{"robotNamespace", "ns"}, {"rolling", "true"}}, {}, {}, lidar()},
      {"libtrident_lidar3d.so",
       {{"robotNamespace", "ns"}, {"gaussianNoise", "0.01"}},
       {},
       {"min_range", "max_range", "min_intensity", "gaussianNoise", "beamPeriod"},
       lidar()},
      {"libgazebo_ros_velodyne_laser.so",
       {{"robotNamespace", "ns"}, {"topicName", "points"}},
       {},
       {"min_range", "max_range", "min_intensity", "gaussianNoise"},
       lidar()},
      {"libgazebo_ros_velodyne_gpu_laser.so",
       {{"robotNamespace", "ns"}, {"topicName", "points"}},
       {},
       {"min_range", "max_range", "min_intensity", "gaussianNoise"},
       lidar()},
      {"libhector_gazebo_ros_sonar.so",
       {{"robotNamespace", "ns"}, {"gaussianNoise", "0.01"}, {"updateRate", "50"}},
       {},
       {"gaussianNoise", "drift", "updateRate"},
       lidar()},
      {"libgazebo_ros_range.so",
       {{"robotNamespace", "ns"}, {"gaussianNoise", "0.01"}},
       {},
       {"gaussianNoise", "fov", "updateRate"},
       lidar()},
      {"libgazebo_ros_block_laser.so",
       {{"robotNamespace", "ns"}, {"gaussianNoise", "0.01"}},
       {},
       {"gaussianNoise", "updateRate"},
       lidar()},
      {"libgazebo_ros_bumper.so", {{"robotNamespace", "ns"}}, {}, {}, bumper()},
      {"libtrident_gnss.so",
       {{"robotNamespace", "ns"}, {"floatTime", "0.1"}, {"fixedTime", "0.3"}},
       {},
       {"satellites", "rtkSatellites", "floatTime", "fixedTime", "singleHorizontalStdDev",
        "fixedVerticalStdDev"},
       sensor_of("gps")},
      {"librotors_gazebo_gps_plugin.so",
       {{"robotNamespace", "ns"}},
       {},
       {"horPosStdDev", "verPosStdDev", "horVelStdDev", "verVelStdDev"},
       sensor_of("gps")},
      {"libgazebo_ros_imu_sensor.so",
       {{"robotNamespace", "ns"}, {"frameName", "imu"}, {"gaussianNoise", "0.1"}},
       {"frameName"},
       {"gaussianNoise", "updateRateHZ", "xyzOffset", "rpyOffset"},
       sensor_of("imu")},
  };
}

}  // namespace

std::vector<PluginCase> builtin_plugin_cases() {
  std::vector<PluginCase> cases = model_cases();
  for (PluginCase& plugin : sensor_cases()) cases.push_back(std::move(plugin));
  for (PluginCase& plugin : camera_cases()) cases.push_back(std::move(plugin));
  return cases;
}

}  // namespace trident::sim
