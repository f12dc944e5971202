// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include "running_loop.h"
#include "transport/byte_queue.h"
#include "transport/descriptor.h"
#include "transport/socket_address.h"

namespace trident::bridges {
namespace {

std::string url_to(std::uint16_t port) { return "tcp://127.0.0.1:" + std::to_string(port); }

// A client that only does what a test says.
Descriptor connect_to(std::uint16_t port, int receive_buffer = 0) {
  Descriptor result(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (receive_buffer > 0) {
    setsockopt(result.get(), SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof(receive_buffer));
  }
  const SocketAddress server = resolve("", "127.0.0.1", port);
  EXPECT_EQ(connect(result.get(), server.get(), server.size), 0);
  return result;
}

std::string receive_all(int socket) {
  std::string result(1 << 20, '\0');
  const auto size = recv(socket, result.data(), result.size(), MSG_DONTWAIT);
  result.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return result;
}

TEST(Tcp, AClientAndAServerTalk) {
  EpollLoop loop;
  Recorded server(loop, "tcp-l://");
  Recorded client(loop, url_to(server.endpoint->port()));
  ASSERT_TRUE(run_until(loop, [&] { return client.has_joined() && server.has_joined(); }));
  const std::string question = "question", mark = "?";
  const std::vector<Bytes> parts{bytes_of(question), bytes_of(mark)};
  EXPECT_EQ(client.endpoint->send_batch(1, parts), 2);
  ASSERT_TRUE(run_until(loop, [&] { return server.text[1] == "question?"; }));
  EXPECT_EQ(server.endpoint->send_to_all(bytes_of("answer")), 1);
  ASSERT_TRUE(run_until(loop, [&] { return client.text[1] == "answer"; }));
  server.endpoint->drop(1);
  ASSERT_TRUE(run_until(loop, [&] { return !client.left.empty(); }));
  EXPECT_EQ(client.left.at(1), "closed by the peer");
  EXPECT_TRUE(server.left.empty());
}

TEST(Tcp, AClientConnectsOnceTheServerIsThereAndAgainAfterItsRestart) {
  EpollLoop loop;
  auto first = std::make_unique<Recorded>(loop, "tcp-l://");
  const std::uint16_t port = first->endpoint->port();
  first.reset();
  EndpointOptions options = Recorded::options_of(url_to(port));
  options.retry_s = 0.01;
  Recorded client(loop, options);
  ASSERT_TRUE(run_until(loop, [&] { return !client.warnings.empty(); }));
  EXPECT_NE(client.warnings[0].find("Connection refused; it is tried again every 0.01 s"),
            std::string::npos);
  const std::string server_url = "tcp-l://:" + std::to_string(port);
  for (std::size_t run = 1; run <= 2; ++run) {
    Recorded server(loop, server_url);
    ASSERT_TRUE(run_until(loop, [&] { return client.joined.size() == run; }));
    ASSERT_TRUE(run_until(loop, [&] { return server.has_joined(); }));
  }
  EXPECT_EQ(client.endpoint->counts().reconnects, 1U);
  // The next outage is reported again.
  ASSERT_TRUE(run_until(loop, [&] { return client.warnings.size() == 2; }));
}

TEST(Tcp, ASlowReaderIsCutByWholeBlocksAndTheOthersGetEverything) {
  EpollLoop loop;
  EndpointOptions options = Recorded::options_of("tcp-l://");
  options.queue_bytes = 8192;
  options.socket_buffer = 4096;
  Recorded server(loop, options);
  const Descriptor slow = connect_to(server.endpoint->port(), 4096);
  ASSERT_TRUE(run_until(loop, [&] { return server.joined.size() == 1; }));
  Recorded fast(loop, url_to(server.endpoint->port()));
  ASSERT_TRUE(run_until(loop, [&] { return server.joined.size() == 2; }));
  const std::string block = std::string(999, 'x') + "\n";
  for (std::size_t sent = 0; sent < 500; ++sent) {
    server.endpoint->send_to_all(bytes_of(block));
    ASSERT_TRUE(run_until(loop, [&] { return fast.text[1].size() == (sent + 1) * block.size(); }));
  }
  const std::uint64_t cut = server.endpoint->counts().cut;
  EXPECT_GT(cut, 0U);
  std::string received;
  ASSERT_TRUE(run_until(loop, [&] {
    received += receive_all(slow.get());
    return received.size() == (500 - cut) * block.size();
  }));
  for (std::size_t i = 0; i < received.size(); i += block.size()) {
    ASSERT_EQ(received.substr(i, block.size()), block);
  }
}

TEST(Tcp, ABlockThatIsLongerThanTheQueueIsCut) {
  EpollLoop loop;
  EndpointOptions options = Recorded::options_of("tcp-l://");
  options.queue_bytes = 1024;
  Recorded server(loop, options);
  const Descriptor client = connect_to(server.endpoint->port());
  ASSERT_TRUE(run_until(loop, [&] { return server.has_joined(); }));
  const std::string small = "small", large(1025, 'x');
  const std::vector<Bytes> blocks{bytes_of(small), bytes_of(large), bytes_of(small)};
  EXPECT_EQ(server.endpoint->send_batch(1, blocks), 2);
  EXPECT_EQ(server.endpoint->counts().cut, 1U);
  std::string received;
  EXPECT_TRUE(
      run_until(loop, [&] { return (received += receive_all(client.get())).size() == 10; }));
  EXPECT_EQ(received, "smallsmall");
}

TEST(Tcp, HundredsOfIdleConnectionsLeaveTheAdmittedOnesAlone) {
  EpollLoop loop;
  EndpointOptions options = Recorded::options_of("tcp-l://");
  options.max_peers = 3;
  Recorded server(loop, options);
  Recorded client(loop, url_to(server.endpoint->port()));
  ASSERT_TRUE(run_until(loop, [&] { return server.has_joined(); }));
  std::vector<Descriptor> idle;
  for (int i = 0; i < 300; ++i) idle.push_back(connect_to(server.endpoint->port()));
  ASSERT_TRUE(run_until(loop, [&] { return server.endpoint->counts().refused_peers == 298; }));
  EXPECT_EQ(server.endpoint->peers().size(), 3U);
  client.endpoint->send(1, bytes_of("still here"));
  EXPECT_TRUE(run_until(loop, [&] { return server.text[1] == "still here"; }));
  idle.clear();
  EXPECT_TRUE(run_until(loop, [&] { return server.left.size() == 2; }));
  EXPECT_EQ(server.warnings.size(), 1U);
}

TEST(Tcp, WithoutFreeDescriptorsAConnectionWaits) {
  EpollLoop loop;
  Recorded server(loop, "tcp-l://");
  const Descriptor client = connect_to(server.endpoint->port());
  rlimit before{};
  getrlimit(RLIMIT_NOFILE, &before);
  const Descriptor lowest(fcntl(client.get(), F_DUPFD_CLOEXEC, 0));
  const rlimit none{static_cast<rlim_t>(lowest.get()), before.rlim_max};
  setrlimit(RLIMIT_NOFILE, &none);
  const bool is_refused = run_until(loop, [&] { return !server.warnings.empty(); });
  setrlimit(RLIMIT_NOFILE, &before);
  ASSERT_TRUE(is_refused);
  EXPECT_FALSE(server.has_joined());
  EXPECT_TRUE(run_until(loop, [&] { return server.has_joined(); }));
}

TEST(Tcp, APortOfItsOwnIsNoServer) {
  // A client whose own port is the server's would otherwise talk to itself.
  EpollLoop loop;
  const Descriptor bound(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  SocketAddress address = resolve("", "127.0.0.1", 0);
  ASSERT_EQ(bind(bound.get(), address.get(), address.size), 0);
  Recorded client(loop, url_to(local_address(bound.get()).port()));
  ASSERT_TRUE(run_until(loop, [&] { return !client.warnings.empty(); }));
  EXPECT_FALSE(client.has_joined());
}

TEST(Tcp, AHostThatIsUnknownOrRemoteIsRefused) {
  EXPECT_NE(refusal_of(Recorded::options_of("tcp://10.1.2.3:5760")).find("not loopback"),
            std::string::npos);
  EXPECT_NE(refusal_of(Recorded::options_of("tcp://127.0.0.1")).find("port is missing"),
            std::string::npos);
  EXPECT_NE(refusal_of(Recorded::options_of("tcp://no_host.invalid:1")).find("no_host.invalid"),
            std::string::npos);
}

TEST(ByteQueue, ItWrapsAroundAndTakesWholeBlocks) {
  ByteQueue queue(10);
  std::string out;
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(queue.push(bytes_of("abcdefg")));
    EXPECT_FALSE(queue.push(bytes_of("hijk")));
    out.clear();
    for (const Bytes part : queue.front(queue.size())) out.append(part.begin(), part.end());
    ASSERT_EQ(out, "abcdefg");
    queue.pop(3);
    ASSERT_TRUE(queue.push(bytes_of("hij")));
    queue.pop(queue.size());
  }
  EXPECT_TRUE(queue.empty());
}

}  // namespace
}  // namespace trident::bridges
