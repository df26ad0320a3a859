# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Snapshots of a whole scene: all nodes of a namespace."""
import hashlib
import json
import os
import re

import rospy

from vegetation_sim.client import Client, VegetationError
from vegetation_sim.msg import ErrorCode
from vegetation_sim.srv import LoadSnapshot, SaveSnapshot

MANIFEST = 'manifest.json'
FORMAT = 1
SERVICE = '/save_snapshot'
PLAIN_NAME = re.compile('[A-Za-z0-9_-][A-Za-z0-9_.-]{0,63}')
ENTRY = {'file': str, 'bytes': int, 'sha256': str, 'stamp': int}  # what is read of each node


class Scene:
    """All nodes below a namespace that can be saved. They run on this machine, or share their
    ~snapshot_folder with it, in which a snapshot is a folder with one file per node and a manifest
    of their sizes and hashes."""

    def __init__(self, namespace='/', timeout=30.0):
        """`timeout` [s] of wall time limits the wait for each service."""
        self.namespace = rospy.names.canonicalize_name(rospy.resolve_name(namespace))
        self.timeout = timeout

    def nodes(self):
        """Returns the names of the nodes, the wind first, because the others listen to it."""
        services = rospy.get_master().getSystemState()[2][2]
        below = self.namespace.rstrip('/') + '/'
        found = [name[:-len(SERVICE)] for name, _ in services
                 if name.endswith(SERVICE) and name.startswith(below)]
        if not found:
            raise VegetationError('no node below %s offers %s' % (below, SERVICE[1:]),
                                  ErrorCode.NOT_AVAILABLE)
        return sorted(found, key=lambda name: ('wind_broadcaster' not in name, name))

    def save(self, name):
        """Saves all nodes. Returns the manifest. Raises VegetationError if a node cannot; there is
        no manifest then."""
        _check_name(name)
        files = {}
        for node in self.nodes():
            saved = self._call(node, 'save_snapshot', SaveSnapshot, name=name)
            files[node] = {'file': os.path.basename(saved.file), 'bytes': saved.bytes,
                           'sha256': _sum_of(saved.file), 'stamp': saved.stamp.to_nsec(),
                           'hash': saved.hash, 'seconds': round(saved.seconds, 4)}
            folder = os.path.dirname(saved.file)
            _remove(os.path.join(folder, MANIFEST))
        manifest = {'format': FORMAT, 'nodes': files}
        _write(os.path.join(folder, MANIFEST), json.dumps(manifest, indent=1))
        return manifest

    def load(self, name, simulation=None):
        """Loads all nodes. Each checks its file before the first one or the clock changes. With a
        `simulation` the clock is set to the time of the snapshot, so that the states have the same
        hashes as the saved ones; otherwise they continue at the present time. Returns the replies
        by node. Raises VegetationError."""
        saved = self._checked_manifest(name)['nodes']
        nodes = self.nodes()
        for node in nodes:
            self._call(node, 'load_snapshot', LoadSnapshot, name=name, check_only=True)
        if simulation:
            last = max(entry['stamp'] for entry in saved.values())
            simulation.seek(rospy.Time(last // 10 ** 9, last % 10 ** 9))
        return {node: self._call(node, 'load_snapshot', LoadSnapshot, name=name)
                for node in nodes}

    def manifest(self, name):
        """Returns the manifest of a snapshot."""
        _check_name(name)
        path = os.path.join(self._folder(), name, MANIFEST)
        try:
            manifest = json.loads(_read(path))
        except ValueError as error:
            raise _rejected(path, 'cannot be read: %s' % error) from error
        found = manifest.get('format') if isinstance(manifest, dict) else None
        if found != FORMAT:
            raise _rejected(path, 'format = %s, allowed is %d' % (found, FORMAT))
        _check_nodes(path, manifest.get('nodes'))
        return manifest

    def _checked_manifest(self, name):
        manifest, running = self.manifest(name), self.nodes()
        saved = manifest['nodes']
        if sorted(saved) != sorted(running):
            raise _rejected('snapshot %s' % name, 'its nodes are %s; running are %s' % (
                ', '.join(sorted(saved)), ', '.join(sorted(running))))
        for entry in saved.values():
            path = os.path.join(self._folder(), name, os.path.basename(entry['file']))
            if _sum_of(path) != entry['sha256']:
                raise _rejected(path, 'differs from the manifest')
        return manifest

    def _folder(self):
        home = os.environ.get('ROS_HOME') or os.path.expanduser('~/.ros')
        own = os.path.join(home, 'vegetation_sim')
        return rospy.get_param(self.nodes()[0] + '/snapshot_folder', own)

    def _call(self, node, service, kind, **request):
        return Client(node, self.timeout).call(service, kind, **request)


def _rejected(path, why):
    return VegetationError('%s: %s' % (path, why), ErrorCode.FILE_REJECTED)


def _check_name(name):
    """Raises VegetationError for a name that the nodes reject too."""
    if not PLAIN_NAME.fullmatch(name):
        raise VegetationError(
            "name = '%s', allowed are 1 to 64 letters, digits, '_', '-' and '.', not at the "
            "beginning a '.'" % name[:64], ErrorCode.INVALID_VALUE)


def _check_nodes(path, nodes):
    """Raises VegetationError for nodes of a manifest that lack what is read of them."""
    if not isinstance(nodes, dict) or not nodes:
        raise _rejected(path, 'nodes = %.60r, allowed are the nodes by name' % (nodes,))
    for node, entry in nodes.items():
        for key, kind in ENTRY.items():
            value = entry.get(key) if isinstance(entry, dict) else None
            if not isinstance(value, kind):
                raise _rejected(path, '%s of %s = %.60r, allowed is %s' % (
                    key, node, value, 'a text' if kind is str else 'a whole number'))


def _read(path):
    try:
        with open(path, 'rb') as file:
            return file.read()
    except FileNotFoundError as error:
        raise VegetationError('%s: there is no such file' % path, ErrorCode.UNKNOWN) from error
    except OSError as error:
        raise _rejected(path, 'cannot be read: %s' % error.strerror) from error


def _write(path, text):
    """Replaces a file in one step."""
    try:
        with open(path + '.part', 'w') as file:
            file.write(text)
        os.replace(path + '.part', path)
    except OSError as error:
        raise _rejected(path, 'cannot be written: %s' % error.strerror) from error


def _sum_of(path):
    return hashlib.sha256(_read(path)).hexdigest()


def _remove(path):
    try:
        os.remove(path)
    except FileNotFoundError:
        pass
    except OSError as error:
        raise _rejected(path, 'cannot be removed: %s' % error.strerror) from error
