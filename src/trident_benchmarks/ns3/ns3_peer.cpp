// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What ns-3 says of the radios that the simulator models: `./trident bench links` builds this where
// libns3-dev is installed, and runs it next to its own measurements.
//   ns3_peer --task=per --width=20                     lines `mcs bytes snr_db loss`
//   ns3_peer --task=goodput --mcs=7 --stations=5 …     one line, Mbit/s of payload at the sink
#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>
#include <string>

#include "ns3/core-module.h"
#include "ns3/internet-module.h"
#include "ns3/mobility-module.h"
#include "ns3/network-module.h"
#include "ns3/propagation-module.h"
#include "ns3/table-based-error-rate-model.h"
#include "ns3/udp-client-server-helper.h"
#include "ns3/wifi-module.h"

namespace trident {
namespace {

using namespace ns3;  // NOLINT(google-build-using-namespace): ns-3's own style of programs

constexpr double kRadius_m = 10.0;
constexpr double kBegin_s = 1.0, kWarmUp_s = 2.0;
constexpr double kHidden_db = 300.0;

/// What a run is asked for.
struct Options {
  std::string task = "goodput";
  std::uint32_t mcs = 7, width = 20, max_ampdu = 0, payload = 1472, stations = 1, seed = 1;
  double seconds = 5.0, offered_mbit_s = 40.0;
  /// Packets that each station's queue holds, and how long [ms].
  std::uint32_t queue = 500, queue_ms = 500;
  bool is_hidden = false;  ///< the stations do not hear each other
};

std::string mode_name(std::uint32_t mcs) { return "VhtMcs" + std::to_string(mcs); }

// Loss of frames by their ratio of signal to noise, for all modes that the width has.
void print_losses(std::uint32_t width) {
  const auto model = CreateObject<TableBasedErrorRateModel>();
  for (std::uint32_t mcs = 0; mcs < 10; ++mcs) {
    if (mcs == 9 && width == 20) continue;
    const WifiMode mode(mode_name(mcs));
    const WifiTxVector vector(mode, 0, WIFI_PREAMBLE_VHT_SU, 800, 1, 1, 0,
                              static_cast<std::uint16_t>(width), false);
    for (const std::uint32_t bytes : {100u, 1500u}) {
      for (int i = -100; i <= 700; ++i) {
        const double snr_db = 0.05 * i;
        const double success =
            model->GetChunkSuccessRate(mode, vector, std::pow(10.0, 0.1 * snr_db), 8 * bytes);
        std::cout << mcs << ' ' << bytes << ' ' << snr_db << ' ' << 1.0 - success << '\n';
      }
    }
  }
}

// A sink in the middle of a circle, in free space; hidden stations hear the sink alone.
void place(const NodeContainer& nodes) {
  const auto places = CreateObject<ListPositionAllocator>();
  places->Add(Vector(0.0, 0.0, 0.0));
  const std::uint32_t count = nodes.GetN() - 1;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2.0 * M_PI * i / count;
    places->Add(Vector(kRadius_m * std::cos(angle), kRadius_m * std::sin(angle), 0.0));
  }
  MobilityHelper mobility;
  mobility.SetPositionAllocator(places);
  mobility.SetMobilityModel("ns3::ConstantPositionMobilityModel");
  mobility.Install(nodes);
}

Ptr<PropagationLossModel> propagation(const Options& options, const NodeContainer& nodes) {
  const auto friis = CreateObject<FriisPropagationLossModel>();
  friis->SetFrequency(5.18e9);
  if (!options.is_hidden) return friis;
  const auto matrix = CreateObject<MatrixPropagationLossModel>();
  matrix->SetDefaultLoss(kHidden_db);
  for (std::uint32_t i = 1; i < nodes.GetN(); ++i) {
    const auto sink = nodes.Get(0)->GetObject<MobilityModel>();
    const auto own = nodes.Get(i)->GetObject<MobilityModel>();
    matrix->SetLoss(sink, own, -friis->CalcRxPower(0.0, own, sink));
  }
  return matrix;
}

NetDeviceContainer install_radios(const Options& options, const NodeContainer& nodes) {
  const auto channel = CreateObject<YansWifiChannel>();
  channel->SetPropagationLossModel(propagation(options, nodes));
  channel->SetPropagationDelayModel(CreateObject<ConstantSpeedPropagationDelayModel>());
  YansWifiPhyHelper phy;
  phy.SetChannel(channel);
  phy.SetErrorRateModel("ns3::TableBasedErrorRateModel");
  phy.Set("ChannelSettings",
          StringValue("{0, " + std::to_string(options.width) + ", BAND_5GHZ, 0}"));
  phy.Set("TxPowerStart", DoubleValue(20.0));
  phy.Set("TxPowerEnd", DoubleValue(20.0));
  WifiHelper wifi;
  wifi.SetStandard(WIFI_STANDARD_80211ac);
  wifi.SetRemoteStationManager("ns3::ConstantRateWifiManager", "DataMode",
                               StringValue(mode_name(options.mcs)), "ControlMode",
                               StringValue("OfdmRate24Mbps"));
  WifiMacHelper mac;
  mac.SetType("ns3::AdhocWifiMac", "BE_MaxAmpduSize", UintegerValue(options.max_ampdu));
  return wifi.Install(phy, mac, nodes);
}

ApplicationContainer send(const Options& options, const NodeContainer& nodes, std::uint32_t station,
                          std::uint32_t packets, const UdpClientHelper& to) {
  UdpClientHelper client = to;
  client.SetAttribute("MaxPackets", UintegerValue(packets));
  client.SetAttribute("PacketSize", UintegerValue(options.payload));
  client.SetAttribute("Interval",
                      TimeValue(Seconds(8e-6 * options.payload / options.offered_mbit_s)));
  return client.Install(nodes.Get(station));
}

// Returns the sink's server. Each station offers more than its share; it has asked for its address
// and agreed on acknowledgements before, one station after the other, so that these do not collide.
Ptr<UdpServer> install_traffic(const Options& options, const NodeContainer& nodes,
                               const NetDeviceContainer& devices) {
  InternetStackHelper().Install(nodes);
  Ipv4AddressHelper addresses("10.0.0.0", "255.255.255.0");
  const Ipv4InterfaceContainer interfaces = addresses.Assign(devices);
  constexpr std::uint16_t kPort = 9;
  UdpServerHelper server(kPort);
  server.Install(nodes.Get(0)).Start(Seconds(0.0));
  const UdpClientHelper to(interfaces.GetAddress(0), kPort);
  for (std::uint32_t i = 1; i < nodes.GetN(); ++i) {
    send(options, nodes, i, 10, to).Start(Seconds(0.04 * i));
    send(options, nodes, i, std::numeric_limits<std::uint32_t>::max(), to)
        .Start(Seconds(kBegin_s + 0.001 * i));
  }
  return server.GetServer();
}

double goodput_mbit_s(const Options& options) {
  RngSeedManager::SetSeed(1);
  RngSeedManager::SetRun(options.seed);
  Config::SetDefault("ns3::WifiMacQueue::MaxSize",
                     QueueSizeValue(QueueSize(QueueSizeUnit::PACKETS, options.queue)));
  Config::SetDefault("ns3::WifiMacQueue::MaxDelay", TimeValue(MilliSeconds(options.queue_ms)));
  NodeContainer nodes;
  nodes.Create(options.stations + 1);
  place(nodes);
  const Ptr<UdpServer> server = install_traffic(options, nodes, install_radios(options, nodes));
  std::uint64_t before = 0;
  Simulator::Schedule(Seconds(kWarmUp_s), [&] { before = server->GetReceived(); });
  Simulator::Stop(Seconds(kWarmUp_s + options.seconds));
  Simulator::Run();
  const auto received = static_cast<double>(server->GetReceived() - before);
  Simulator::Destroy();
  return 8e-6 * received * options.payload / options.seconds;
}

int run(int argc, char** argv) {
  Options options;
  CommandLine line(__FILE__);
  line.AddValue("task", "per or goodput", options.task);
  line.AddValue("mcs", "0 to 9", options.mcs);
  line.AddValue("width", "of the channel [MHz]", options.width);
  line.AddValue("max_ampdu", "0: each frame alone [bytes]", options.max_ampdu);
  line.AddValue("payload", "of a datagram [bytes]", options.payload);
  line.AddValue("stations", "that send", options.stations);
  line.AddValue("seconds", "that are counted", options.seconds);
  line.AddValue("offered", "by each station [Mbit/s]", options.offered_mbit_s);
  line.AddValue("queue", "of a station [packets]", options.queue);
  line.AddValue("queue_ms", "how long a packet waits at most [ms]", options.queue_ms);
  line.AddValue("hidden", "the stations hear the sink alone", options.is_hidden);
  line.AddValue("seed", "of the random numbers", options.seed);
  line.Parse(argc, argv);
  if (options.task == "per") {
    print_losses(options.width);
    return 0;
  }
  std::cout << goodput_mbit_s(options) << '\n';
  return 0;
}

}  // namespace
}  // namespace trident

int main(int argc, char** argv) { return trident::run(argc, argv); }
