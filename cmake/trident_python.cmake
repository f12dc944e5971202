# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0

function(trident_add_pytest name dir)
endfunction()
