#!/usr/bin/env bash
# Usage: no_world.sh PROGRAM...
# Programs that link seam::arm: no library of a world, of collision or of meshes may come with it.
set -u
failed=0
for program; do
  needed=$(ldd "$program") || failed=1
  [[ $needed = *libBulletInverseDynamics* ]] || { echo "$program: needs no inverse dynamics: $needed"; failed=1; }
  for library in BulletDynamics BulletCollision BulletSoftBody assimp; do
    [[ $needed != *$library* ]] || { echo "$program: needs $library"; failed=1; }
  done
done
exit $failed
