// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gazebo_msgs/GetPhysicsProperties.h>
#include <gazebo_msgs/SetPhysicsProperties.h>
#include <std_msgs/String.h>
#include <std_srvs/Empty.h>
#include <trident_msgs/EnrollSource.h>
#include <trident_msgs/Step.h>

#include "conversions/conversions.h"
#include "services.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

const ros::Duration kDefaultPeriod(0.1);  ///< of set-point sources that give none

using gazebo_msgs::GetPhysicsProperties;
using gazebo_msgs::SetPhysicsProperties;
using trident_msgs::EnrollSource;
using trident_msgs::Step;
using StepEvent = ros::ServiceEvent<Step::Request, Step::Response>;

void get_physics(Simulation& simulation, GetPhysicsProperties::Response& response) {
  Simulation::Access access(simulation);
  const PhysicsSpec& physics = access.world().physics();
  response.time_step = physics.max_step_size_s;
  response.pause = simulation.paused();
  response.max_update_rate = simulation.max_update_rate_hz();
  response.gravity = to_vector(physics.gravity);
  auto& ode = response.ode_config;
  ode.sor_pgs_precon_iters = static_cast<std::uint32_t>(physics.precon_iterations);
  ode.sor_pgs_iters = static_cast<std::uint32_t>(physics.iterations);
  ode.sor_pgs_w = physics.sor;
  ode.contact_surface_layer = physics.contact_surface_layer;
  ode.contact_max_correcting_vel = physics.contact_max_correcting_vel;
  ode.cfm = physics.cfm;
  ode.erp = physics.erp;
  ode.max_contacts = static_cast<std::uint32_t>(physics.max_contacts);
  response.status_message = "GetPhysicsProperties: got properties";
}

void set_physics(Simulation& simulation, const SetPhysicsProperties::Request& request) {
  Simulation::Access access(simulation);
  PhysicsSpec physics = access.world().physics();
  const auto& ode = request.ode_config;
  physics.max_step_size_s = request.time_step;
  physics.gravity = from_vector(request.gravity);
  physics.precon_iterations = static_cast<int>(ode.sor_pgs_precon_iters);
  physics.iterations = static_cast<int>(ode.sor_pgs_iters);
  physics.sor = ode.sor_pgs_w;
  physics.contact_surface_layer = ode.contact_surface_layer;
  physics.contact_max_correcting_vel = ode.contact_max_correcting_vel;
  physics.cfm = ode.cfm;
  physics.erp = ode.erp;
  physics.max_contacts = static_cast<int>(ode.max_contacts);
  if (!(request.max_update_rate >= 0.0)) {
    throw Error("max_update_rate is " + std::to_string(request.max_update_rate) +
                ", must be >= 0 Hz (0: as fast as possible)");
  }
  // What the message does not have, such as the solver, stays.
  access.changed_by("/gazebo/set_physics_properties").set_physics(physics);
  simulation.set_max_update_rate_hz(request.max_update_rate);
}

void step(Simulation& simulation, const StepEvent& event) {
  const Step::Request& request = event.getRequest();
  Step::Response& response = event.getResponse();
  try {
    if (request.n == 0) throw Error("n is 0, must be >= 1");
    response.sim_time = to_ros(simulation.step(request.n, event.getCallerName()));
    response.success = true;
  } catch (const Error& error) {
    response.message = std::string("Step: ") + error.what();
    response.success = false;
  }
}

void enroll(Simulation& simulation, const EnrollSource::Request& request,
            EnrollSource::Response& response) {
  try {
    Simulation::Access access(simulation);
    if (request.enroll) {
      const ros::Duration period = request.period.isZero() ? kDefaultPeriod : request.period;
      response.start_time =
          to_ros(simulation.enroll_source(request.node, request.vehicles, from_ros(period),
                                          from_ros(request.end_time), request.waits_beyond_end));
    } else {
      simulation.release_source(request.node);
    }
    response.success = true;
  } catch (const Error& error) {
    response.message = error.what();
    response.success = false;
  }
}

template <class Work>
void serve_empty(ros::NodeHandle& node, const char* name, Servers& servers, Work work) {
  servers.push_back(node.advertiseService<std_srvs::Empty::Request, std_srvs::Empty::Response>(
      name, [work](std_srvs::Empty::Request&, std_srvs::Empty::Response&) {
        work();
        return true;
      }));
}

}  // namespace

void subscribe_run_topics(ros::NodeHandle& node, Simulation& simulation,
                          std::vector<ros::Subscriber>& subscribers) {
  using Event = const ros::MessageEvent<std_msgs::String const>&;
  ros::SubscribeOptions options;
  options.initByFullCallbackType<Event>("not_repeatable", 10, [&simulation](Event event) {
    const Simulation::Access access(simulation);
    simulation.spoil(event.getPublisherName(), event.getMessage()->data);
  });
  subscribers.push_back(node.subscribe(options));
}

void advertise_run_services(ros::NodeHandle& node, Simulation& simulation, Servers& servers) {
  const auto set_paused = [&simulation](bool paused) {
    return [&simulation, paused] {
      Simulation::Access access(simulation);
      simulation.set_paused(paused);
    };
  };
  const auto reset = [&simulation](bool with_time) {
    return [&simulation, with_time] {
      Simulation::Access access(simulation);
      simulation.reset(with_time);
    };
  };
  serve_empty(node, "pause_physics", servers, set_paused(true));
  serve_empty(node, "unpause_physics", servers, set_paused(false));
  serve_empty(node, "reset_world", servers, reset(false));
  serve_empty(node, "reset_simulation", servers, reset(true));
  servers.push_back(
      node.advertiseService<GetPhysicsProperties::Request, GetPhysicsProperties::Response>(
          "get_physics_properties", [&](GetPhysicsProperties::Request&, auto& response) {
            return answer(response,
                          "GetPhysicsProperties: ", [&] { get_physics(simulation, response); });
          }));
  servers.push_back(
      node.advertiseService<SetPhysicsProperties::Request, SetPhysicsProperties::Response>(
          "set_physics_properties", [&](SetPhysicsProperties::Request& request, auto& response) {
            return answer(response, "SetPhysicsProperties: ", [&] {
              set_physics(simulation, request);
              response.status_message = "physics engine updated";
            });
          }));
  // As an event, which has the caller's name: a node
  // whose answer the world waits for must not step it.
  ros::AdvertiseServiceOptions stepping;
  stepping.initBySpecType<StepEvent>("step", [&simulation](const StepEvent& event) {
    step(simulation, event);
    return true;
  });
  servers.push_back(node.advertiseService(stepping));
  servers.push_back(node.advertiseService<EnrollSource::Request, EnrollSource::Response>(
      "enroll_source", [&](EnrollSource::Request& request, EnrollSource::Response& response) {
        enroll(simulation, request, response);
        return true;
      }));
}

}  // namespace trident::sim
