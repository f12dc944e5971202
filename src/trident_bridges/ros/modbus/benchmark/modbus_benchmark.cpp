// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// modbus_benchmark codec              what a request and its response cost, by CPU time
// modbus_benchmark tcp SECONDS WINDOW 125 registers read again and again over TCP on loopback, by
// two processes
//
// Prints lines "NAME VALUE".
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "trident_base/error.h"
#include "trident_base/option_number.h"
#include "trident_bridges/modbus/response.h"
#include "trident_bridges/modbus/server.h"
#include "trident_bridges/transport/epoll_loop.h"
#include "trident_bridges_ros/modbus/modbus_link.h"

namespace trident::bridges::modbus {
namespace {

const char* const kMap =
    "registers:\n"
    "  - {name: row, table: holding, address: 0, count: 123, access: read_write, publish: poll}\n"
    "  - {name: two, table: holding, address: 123, count: 2, publish: poll}\n";

double cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Calls `work`, which is a request and its response, for about half a second of CPU time; prints
/// how many PDUs that are in one.
template <class Work>
void measure(const char* name, Work work) {
  constexpr double kLong_s = 0.5;
  std::uint64_t done = 0, batch = 1000;
  const double begin_s = cpu_s();
  double spent_s = 0.0;
  while (spent_s < kLong_s) {
    for (std::uint64_t i = 0; i < batch; ++i) work();
    done += batch;
    spent_s = cpu_s() - begin_s;
  }
  std::printf("%s %.0f\n", name, 2.0 * static_cast<double>(done) / spent_s);
}

/// Keeps the compiler from leaving out what has no effect.
template <class Type>
void keep(const Type& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

void measure_tcp_frames(const Request& request, const Pdu& response) {
  std::vector<std::uint8_t> out;
  TcpFrameReader reader;
  measure("pdus_tcp", [&] {
    out.clear();
    const Pdu pdu = encode_request(request);
    append_tcp_frame({1, 1, pdu.bytes()}, out);
    reader.feed(out);
    const auto frame = reader.next();
    keep(decode_request(frame->pdu));
    out.clear();
    append_tcp_frame({1, 1, response.bytes()}, out);
    reader.feed(out);
    keep(decode_response(request, reader.next()->pdu));
  });
}

void measure_rtu_frames(const Request& request, const Pdu& response) {
  std::vector<std::uint8_t> out;
  RtuFrameReader reader(0.004, false);
  measure("pdus_rtu", [&] {
    for (const Bytes pdu : {encode_request(request).bytes(), response.bytes()}) {
      out.clear();
      append_rtu_frame(1, pdu, out);
      reader.feed(out, 0.0);
      keep(reader.next(0.0));
    }
  });
}

void codec() {
  Server server(parse_register_map(kMap, "benchmark"), {});
  const Caller caller;
  const Request read = read_request(Function::kReadHoldingRegisters, 0, 125);
  const Pdu read_pdu = encode_request(read);
  const Pdu response = *server.handle(caller, 1, read_pdu.bytes(), 0.0);
  measure_tcp_frames(read, response);
  measure_rtu_frames(read, response);
  measure("pdus_read_125", [&] { keep(server.handle(caller, 1, read_pdu.bytes(), 0.0)); });
  const std::vector<std::uint8_t> values(246, 1);
  const Pdu write =
      encode_request(write_request(Function::kWriteMultipleRegisters, 0, 123, values));
  measure("pdus_write_123", [&] { keep(server.handle(caller, 1, write.bytes(), 0.0)); });
}

void serve(int port_pipe) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  EpollLoop loop;
  Server server(parse_register_map(kMap, "benchmark"), {});
  TransportSpec transport;
  transport.port = 0;
  ModbusLink* own = nullptr;
  LinkEvents events;
  events.frame = [&](const LinkFrame& frame) {
    const auto response = server.handle({frame.peer, ""}, frame.unit, frame.pdu, 0.0);
    if (response) own->send(frame.peer, frame.unit, frame.transaction, response->bytes());
  };
  ModbusLink link(transport, Role::kServer, {}, loop, std::move(events));
  own = &link;
  const std::uint16_t port = link.port();
  if (write(port_pipe, &port, sizeof(port)) != sizeof(port)) return;
  loop.run();
}

void ask(std::uint16_t port, double seconds, int window) {
  EpollLoop loop;
  TransportSpec transport;
  transport.port = port;
  const Request read = read_request(Function::kReadHoldingRegisters, 0, 125);
  const Pdu request = encode_request(read);
  ModbusLink* own = nullptr;
  std::uint64_t responses = 0, wrong = 0;
  std::uint16_t number = 0;
  double begin_s = 0.0;
  LinkEvents events;
  events.frame = [&](const LinkFrame& frame) {
    ++responses;
    if (decode_response(read, frame.pdu).kind != Response::Kind::kDone) ++wrong;
    own->send(frame.peer, 1, ++number, request.bytes());
  };
  events.joined = [&](PeerId peer) {
    begin_s = loop.now_s();
    for (int i = 0; i < window; ++i) own->send(peer, 1, ++number, request.bytes());
    own->flush();
  };
  ModbusLink link(transport, Role::kClient, {}, loop, std::move(events));
  own = &link;
  const double cpu_begin_s = cpu_s();
  while (begin_s == 0.0 || loop.now_s() < begin_s + seconds) loop.run_once(0.1);
  const double spent_s = loop.now_s() - begin_s;
  std::printf("responses_s %.0f\n", static_cast<double>(responses) / spent_s);
  std::printf("mbit_s %.2f\n", 125e-6 * 16 * static_cast<double>(responses) / spent_s);
  std::printf("client_cpu_us %.2f\n",
              1e6 * (cpu_s() - cpu_begin_s) / static_cast<double>(responses));
  std::printf("wrong %llu\n", static_cast<unsigned long long>(wrong));
}

int run(const std::vector<std::string>& words) {
  if (words == std::vector<std::string>{"codec"}) {
    codec();
    return 0;
  }
  if (words.size() != 3 || words[0] != "tcp") throw Error("legal: codec, tcp SECONDS WINDOW");
  const double seconds = option_number("SECONDS", words[1], 0.1, 600.0);
  const auto window = static_cast<int>(option_count("WINDOW", words[2], 1, 16));
  int ends[2];
  if (pipe(ends) != 0) throw Error("pipe");
  const pid_t child = fork();
  if (child == 0) {
    serve(ends[1]);
    _exit(0);
  }
  std::uint16_t port = 0;
  if (read(ends[0], &port, sizeof(port)) != sizeof(port)) throw Error("the server did not start");
  ask(port, seconds, window);
  kill(child, SIGKILL);
  return 0;
}

}  // namespace
}  // namespace trident::bridges::modbus

int main(int argc, char** argv) {
  try {
    return trident::bridges::modbus::run({argv + 1, argv + argc});
  } catch (const trident::Error& error) {
    std::fprintf(stderr, "modbus_benchmark: %s\n", error.what());
    return 1;
  }
}
