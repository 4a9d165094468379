#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Gradescope runs this once, when it makes the image: the packages of fbd lie in the archive beside it.
set -eu
apt-get update
apt-get install -y --no-install-recommends python3 /autograder/source/libfbd0_*.deb /autograder/source/fbd_*.deb
