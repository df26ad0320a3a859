#!/bin/bash
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
# Runs a test of a display that was built with the address sanitizer. The test must be linked with
# the sanitizer. If the sanitizer is preloaded, it starts within the first allocation, the newlocale
# of libp11-kit. The first message of the sanitizer then unlocks the lock of all locales once too
# often, and later users of that lock (Mesa's first regular expression, Qt's exit) wait for ever.
here=$(dirname "$0")
# Ogre deletes some of its own objects through a base class of another size.
export ASAN_OPTIONS=new_delete_type_mismatch=0
export LSAN_OPTIONS=suppressions=$here/leaks_of_others.txt:print_suppressions=0
exec "$@"
