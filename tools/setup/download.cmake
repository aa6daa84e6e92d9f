# SPDX-License-Identifier: GPL-2.0-only
# cmake -DURL=... -DSHA256=... -DFILE=... -P download.cmake: a download that is checked
file(DOWNLOAD "${URL}" "${FILE}" STATUS status TLS_VERIFY ON)
list(GET status 0 code)
if(NOT code EQUAL 0)
  list(GET status 1 reason)
  file(REMOVE "${FILE}")
  message(FATAL_ERROR "${URL}: ${reason}")
endif()
file(SHA256 "${FILE}" found)
if(NOT found STREQUAL SHA256)
  file(REMOVE "${FILE}")
  message(FATAL_ERROR "${URL} has sha256 ${found}, not ${SHA256}: not used")
endif()
