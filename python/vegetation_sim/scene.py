# Copyright 2026 vegetation_sim developers
# SPDX-License-Identifier: BSD-3-Clause
"""Snapshots of a whole scene: all nodes of a namespace."""
import hashlib
import json
import os

import rospy

from vegetation_sim.client import Client, VegetationError
from vegetation_sim.srv import LoadSnapshot, SaveSnapshot

MANIFEST = 'manifest.json'
FORMAT = 1
SERVICE = '/save_snapshot'


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
            raise VegetationError('no node below %s offers %s' % (below, SERVICE[1:]))
        return sorted(found, key=lambda name: ('wind_broadcaster' not in name, name))

    def save(self, name):
        """Saves all nodes. Returns the manifest. Raises VegetationError if a node cannot; there is
        no manifest then."""
        files = {}
        for node in self.nodes():
            saved = self._call(node, 'save_snapshot', SaveSnapshot, name=name)
            files[node] = {'file': os.path.basename(saved.file), 'bytes': saved.bytes,
                           'sha256': _sum_of(saved.file), 'stamp': saved.stamp.to_nsec(),
                           'hash': saved.hash, 'seconds': round(saved.seconds, 4)}
            folder = os.path.dirname(saved.file)
            _remove(os.path.join(folder, MANIFEST))
        manifest = {'format': FORMAT, 'nodes': files}
        path = os.path.join(folder, MANIFEST)
        with open(path + '.part', 'w') as file:
            json.dump(manifest, file, indent=1)
        os.replace(path + '.part', path)
        return manifest

    def load(self, name, simulation=None):
        """Loads all nodes. Each checks its file before the first one changes. With a `simulation`
        the clock is set to the time of the snapshot, so that the states have the same hashes as
        the saved ones; otherwise they continue at the present time. Returns the replies by node.
        Raises VegetationError."""
        saved = self._checked_manifest(name)['nodes']
        nodes = self.nodes()
        if simulation:
            last = max(entry['stamp'] for entry in saved.values())
            simulation.seek(rospy.Time(last // 10 ** 9, last % 10 ** 9))
        for node in nodes:
            self._call(node, 'load_snapshot', LoadSnapshot, name=name, check_only=True)
        return {node: self._call(node, 'load_snapshot', LoadSnapshot, name=name)
                for node in nodes}

    def manifest(self, name):
        """Returns the manifest of a snapshot."""
        path = os.path.join(self._folder(), name, MANIFEST)
        try:
            with open(path) as file:
                manifest = json.load(file)
        except (OSError, ValueError) as error:
            raise VegetationError('%s: cannot be read: %s' % (path, error)) from error
        found = manifest.get('format') if isinstance(manifest, dict) else None
        if found != FORMAT:
            raise VegetationError('%s: format = %s, allowed is %d' % (path, found, FORMAT))
        return manifest

    def _checked_manifest(self, name):
        manifest, running = self.manifest(name), self.nodes()
        saved = manifest['nodes']
        if sorted(saved) != sorted(running):
            raise VegetationError('snapshot %s is of the nodes %s; running are %s' % (
                name, ', '.join(sorted(saved)), ', '.join(sorted(running))))
        for entry in saved.values():
            path = os.path.join(self._folder(), name, os.path.basename(entry['file']))
            if _sum_of(path) != entry['sha256']:
                raise VegetationError('%s: differs from the manifest' % path)
        return manifest

    def _folder(self):
        home = os.environ.get('ROS_HOME') or os.path.expanduser('~/.ros')
        own = os.path.join(home, 'vegetation_sim')
        return rospy.get_param(self.nodes()[0] + '/snapshot_folder', own)

    def _call(self, node, service, kind, **request):
        return Client(node, self.timeout).call(service, kind, **request)


def _sum_of(path):
    try:
        with open(path, 'rb') as file:
            return hashlib.sha256(file.read()).hexdigest()
    except OSError as error:
        raise VegetationError('%s: cannot be read: %s' % (path, error)) from error


def _remove(path):
    if os.path.exists(path):
        os.remove(path)
