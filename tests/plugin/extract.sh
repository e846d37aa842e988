#!/usr/bin/env bash
# Writes the files of a document's fenced blocks ("```cpp main.cpp") into the current folder, and its commands ("```sh") into
# commands.sh in their order.
set -euo pipefail
awk '
  /^```/ && inside { inside = 0; if (file != "commands.sh") close(file); next }
  /^```sh$/ { inside = 1; file = "commands.sh"; next }
  /^```[a-z]+ [A-Za-z0-9._-]+$/ { inside = 1; file = $2; printf "" > file; next }
  /^```/ { inside = 1; file = "/dev/null"; next }
  inside { print > file }
' "$1"
