# SPDX-License-Identifier: Apache-2.0
# Plain comments of the C interface as Doxygen reads them: before a declaration, behind a member.
1,2s|^/\* |/** @file\n * |
s|^( *)/\* ([^-])|\1/** \2|
s|([;,({0-9a-z] +)/\* |\1/**< |
