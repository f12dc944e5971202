# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0

trident_bridges_room(modbus
  src/modbus/client.cpp
  src/modbus/device_identity.cpp
  src/modbus/field_path.cpp
  src/modbus/map_checks.cpp
  src/modbus/mbap.cpp
  src/modbus/message_definition.cpp
  src/modbus/message_fields.cpp
  src/modbus/message_writer.cpp
  src/modbus/pdu.cpp
  src/modbus/read_blocks.cpp
  src/modbus/register_image.cpp
  src/modbus/register_map.cpp
  src/modbus/response.cpp
  src/modbus/ros_names.cpp
  src/modbus/rtu.cpp
  src/modbus/scalar_codec.cpp
  src/modbus/server.cpp
  src/modbus/topic_bindings.cpp
  src/modbus/value.cpp
  src/modbus/value_type.cpp
  src/modbus/write_queue.cpp
)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
target_link_libraries(trident_bridges_modbus PRIVATE OpenSSL::Crypto)

trident_bridges_test(modbus
  test/modbus/client_test.cpp
  test/modbus/mbap_test.cpp
  test/modbus/message_fields_test.cpp
  test/modbus/mutated_input_test.cpp
  test/modbus/pdu_test.cpp
  test/modbus/register_map_test.cpp
  test/modbus/response_test.cpp
  test/modbus/rtu_test.cpp
  test/modbus/server_test.cpp
  test/modbus/topic_bindings_test.cpp
  test/modbus/value_test.cpp
)
