"""Steps of a packing with the polyhedra of YADE: yade -j1 -n -x yade_steps.py PACKING RESULT

The particles have no friction, and the time step is so short that nothing moves. PACKING has the side of the cube, and the
centre and vertices of every particle. RESULT has the CPU time of a step, a line for each contact with the particles, the
volume and the force, and the contacts that are left when an affine expansion has separated all particles."""

import os
import sys
import time

from yade import polyhedra_utils

STEPS = 10


def main(packing, result):
    with open(packing, encoding="utf-8") as file:
        side, *particles = ([float(number) for number in line.split()] for line in file)
    material = PolyhedraMat(young=1, poisson=1, density=1, frictionAngle=0)
    O.materials.append(material)
    O.periodic = True
    O.cell.setBox(*side * 3)
    for x in particles:
        body = polyhedra_utils.polyhedra(material, v=[Vector3(*x[k:k + 3]) for k in range(3, len(x), 3)])
        body.state.pos = Vector3(*x[:3])
        O.bodies.append(body)
    O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Polyhedra_Aabb()], verletDist=0.02),
                 InteractionLoop([Ig2_Polyhedra_Polyhedra_PolyhedraGeom()], [Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
                                 [Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()]), NewtonIntegrator()]
    O.dt = 1e-12
    O.run(2, True)
    start = time.process_time()
    O.run(STEPS, True)
    seconds = (time.process_time() - start) / STEPS
    lines = [(c.id1, c.id2, c.geom.penetrationVolume, *c.phys.normalForce) for c in O.interactions if c.isReal]
    O.cell.velGrad = Matrix3.Identity * 0.002 / O.dt
    O.run(50, True)
    with open(result, "w", encoding="utf-8") as file:
        print(seconds, sum(c.isReal and c.geom.penetrationVolume > 0.5 for c in O.interactions), file=file)
        for line in lines:
            print(*line, file=file)


main(*sys.argv[1:])
# YADE reports a segmentation fault if it ends in the usual way.
os._exit(0)
