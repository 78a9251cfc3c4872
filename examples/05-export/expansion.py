"""usage: /usr/bin/python3 expansion.py FILE.gsd

Prints the contact number and the share of particles in clusters for every state of a decompression. Needs Debian's
python3-gsd."""

import sys

import gsd.hoomd

with gsd.hoomd.open(sys.argv[1]) as expansion:
    first = expansion[0].particles
    print(f"{first.N} particles, {first.types[0]}, {len(first.type_shapes[0]['vertices'])} vertices each")
    print("delta_phi       Z   in clusters")
    for state in expansion:
        cluster = state.log["particles/isojam/cluster"]
        z = state.log["particles/isojam/Z"].mean()
        print(f"{state.log['isojam/delta_phi'][0]:9.5f} {z:7.3f} {(cluster >= 0).mean():13.2f}")
