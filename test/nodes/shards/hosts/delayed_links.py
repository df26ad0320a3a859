#!/usr/bin/env python3
# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Passes packets between pairs of network interfaces late, and loses some, for kernels without netem.
Runs until it is killed.

usage: delayed_links.py DELAY LOSS INTERFACE:INTERFACE ...   delay [s] and loss [0 to 1] each way"""
import heapq
import random
import selectors
import socket
import sys
import time

SOL_PACKET, PACKET_VNET_HDR, PACKET_IGNORE_OUTGOING = 263, 15, 23  # packet(7), linux/if_packet.h
ALL_PROTOCOLS = 3       # ETH_P_ALL
LONGEST = 65536 + 4096  # bytes of a packet that the sender leaves to be cut into frames


def open_interface(name):
    """Returns a socket for all packets that come in by an interface, with their offload headers, so that
    checksums and lengths that the kernel would fill in later stay as they are."""
    out = socket.socket(socket.AF_PACKET, socket.SOCK_RAW, socket.htons(ALL_PROTOCOLS))
    out.setsockopt(SOL_PACKET, PACKET_VNET_HDR, 1)
    out.setsockopt(SOL_PACKET, PACKET_IGNORE_OUTGOING, 1)
    out.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 24)
    out.bind((name, ALL_PROTOCOLS))
    out.setblocking(False)
    return out


class Links:
    def __init__(self, delay, loss, pairs):
        self._delay, self._loss, self._random = delay, loss, random.Random(1)
        self._selector, self._waiting, self._number = selectors.DefaultSelector(), [], 0
        for pair in pairs:
            ends = [open_interface(name) for name in pair.split(':')]
            for end, other in (ends, ends[::-1]):
                self._selector.register(end, selectors.EVENT_READ, other)

    def _receive(self, end, other):
        while True:
            try:
                packet = end.recv(LONGEST)
            except OSError:  # there is no more, or the link is down
                return
            if self._random.random() < self._loss:
                continue
            self._number += 1
            heapq.heappush(self._waiting, (time.monotonic() + self._delay, self._number, other, packet))

    def _send_due(self):
        """Returns the time until the next packet is due [s]; None: no packet waits."""
        while self._waiting:
            left = self._waiting[0][0] - time.monotonic()
            if left > 0.0:
                return left
            *_, end, packet = heapq.heappop(self._waiting)
            try:
                end.send(packet)
            except OSError as error:  # A link that is down loses what is sent.
                print(error, file=sys.stderr)
        return None

    def run(self):
        while True:
            for key, _ in self._selector.select(self._send_due()):
                self._receive(key.fileobj, key.data)


def main():
    Links(float(sys.argv[1]), float(sys.argv[2]), sys.argv[3:]).run()


if __name__ == '__main__':
    main()
