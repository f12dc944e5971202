# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0

trident_bridges_room(transport
  src/transport/datagram_batch.cpp
  src/transport/epoll_loop.cpp
  src/transport/line_endpoint.cpp
  src/transport/line_sender.cpp
  src/transport/line_settings.cpp
  src/transport/open_endpoint.cpp
  src/transport/pty_endpoint.cpp
  src/transport/serial_endpoint.cpp
  src/transport/socket_address.cpp
  src/transport/socket_buffers.cpp
  src/transport/tcp_client.cpp
  src/transport/tcp_endpoint.cpp
  src/transport/tcp_server.cpp
  src/transport/udp_endpoint.cpp
  src/transport/url.cpp
)
# <asm/termbits.h> and <termios.h> declare the same names.
set_source_files_properties(src/transport/line_settings.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)

trident_bridges_test(transport
  test/transport/epoll_loop_test.cpp
  test/transport/line_test.cpp
  test/transport/tcp_test.cpp
  test/transport/udp_test.cpp
  test/transport/url_test.cpp
)
if(CATKIN_ENABLE_TESTING)
  # Alone, because it replaces malloc.
  catkin_add_gtest(trident_bridges_transport_allocation_test test/transport/allocation_test.cpp)
  target_link_libraries(trident_bridges_transport_allocation_test trident_bridges_transport
    trident_base_test_support gtest_main)
endif()
