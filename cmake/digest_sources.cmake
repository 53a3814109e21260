# SPDX-License-Identifier: Apache-2.0
# cmake -D FILES="a;b" -D WORDS=... -D OUTPUT=map_sources.h -P digest_sources.cmake
# Writes a header with a digest of the files and the words.
set(digests "${WORDS}")
foreach(file ${FILES})
  file(SHA256 ${file} digest)
  string(APPEND digests " ${digest}")
endforeach()
string(SHA256 digest "${digests}")
file(WRITE ${OUTPUT} "// Made by cmake/digest_sources.cmake\n#pragma once\nconstexpr const char* kMapSources = \"${digest}\";\n")
