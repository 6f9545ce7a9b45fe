// What one method's run moves: the arm, what it carries, the trail of its tool. Solid or as a ghost.
import * as THREE from 'three';
import { Line2 } from 'three/addons/lines/Line2.js';
import { LineGeometry } from 'three/addons/lines/LineGeometry.js';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { row_at } from './data.js';
import { liquid_geometry } from './shapes.js';

const solid = new THREE.MeshStandardMaterial({ vertexColors: true, roughness: 0.55, metalness: 0.05 });
const glassy = (alpha) => new THREE.MeshStandardMaterial({ vertexColors: true, roughness: 0.1, transparent: true, opacity: alpha, depthWrite: false, side: THREE.DoubleSide });
const water = new THREE.MeshStandardMaterial({ color: 0x3f8fd2, roughness: 0.15, transparent: true, opacity: 0.85 });
const grain = new THREE.MeshStandardMaterial({ color: 0xd9a441, roughness: 0.6 });
// A ghost that all but agrees with the solid arm stays hidden in it.
const behind = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 60 };
const depth_only = new THREE.MeshBasicMaterial({ colorWrite: false, ...behind });

export class Arm {
  constructor(stage, run, geometries) {
    this.run = run;
    this.motion = run.motion;
    this.group = new THREE.Group();
    this.parts = geometries.map((list) => this.add_part(list));
    this.moving = this.parts.map((_, p) => this.moves(p));
    if (stage.liquid) this.add_liquid(stage.liquid);
    if (stage.grain_radius) this.add_grains(stage.grain_radius);
    this.add_trail();
    this.set_ghost(false);
  }

  add_part(list) {
    const part = new THREE.Group();
    for (const { geometry, alpha } of list) {
      const mesh = new THREE.Mesh(geometry, alpha < 1 ? glassy(alpha) : solid);
      mesh.castShadow = alpha >= 1;
      mesh.receiveShadow = alpha >= 1;
      mesh.userData.own = mesh.material;
      part.add(mesh);
      if (alpha < 1) continue;
      const before = new THREE.Mesh(geometry, depth_only);
      before.renderOrder = 1;
      before.userData.before = true;
      part.add(before);
    }
    this.group.add(part);
    return part;
  }

  // A table stands where it stands with every method: its ghost would only be in the way.
  moves(p) {
    const columns = this.motion.poses.slice(7 * p, 7 * p + 7);
    return columns.some((column) => column.some((value) => Math.abs(value - column[0]) > 1e-3));
  }

  add_liquid(liquid) {
    const { geometry, tilt } = liquid_geometry(liquid);
    this.liquid = new THREE.Mesh(geometry, water);
    this.liquid.renderOrder = -1;
    this.tilt = tilt;
    this.parts[liquid.part].add(this.liquid);
  }

  add_grains(radius) {
    this.grains = new THREE.InstancedMesh(new THREE.SphereGeometry(radius, 14, 10), grain, this.motion.grains.length / 3);
    this.grains.frustumCulled = false;
    this.grains.castShadow = true;
    this.group.add(this.grains);
  }

  add_trail() {
    const [x, y, z] = this.motion.tool;
    const points = Array.from(x, (_, i) => [x[i], y[i], z[i]]).flat();
    this.trail = new Line2(new LineGeometry().setPositions(points), new LineMaterial({ linewidth: 2.5 }));
    this.marks = new THREE.Group();
    this.mark_material = new THREE.MeshBasicMaterial();
    for (const join of this.run.joins) {
      const mark = new THREE.Mesh(new THREE.SphereGeometry(0.007, 16, 12), this.mark_material);
      mark.position.fromArray(this.at(this.motion.tool, join.time));
      this.marks.add(mark);
    }
    this.group.add(this.trail, this.marks);
  }

  colour(css) {
    this.trail.material.color.set(css);
    this.mark_material.color.set(css);
    this.ghost = new THREE.MeshStandardMaterial({ color: css, transparent: true, opacity: 0.4, depthWrite: false, roughness: 0.8, ...behind });
    this.set_ghost(this.is_ghost);
  }

  set_ghost(on) {
    this.is_ghost = on;
    this.parts.forEach((part, p) => {
      part.visible = !on || this.moving[p];
      for (const mesh of part.children) {
        if (mesh === this.liquid) continue;
        if (mesh.userData.before) {
          mesh.visible = on;
          continue;
        }
        mesh.visible = !on || mesh.userData.own === solid;
        mesh.material = on ? this.ghost : mesh.userData.own;
        mesh.castShadow = !on && mesh.material === solid;
        mesh.renderOrder = on ? 2 : 0;
      }
    });
    if (this.liquid) this.liquid.visible = !on;
    if (this.grains) this.grains.visible = !on;
  }

  // A row between two frames, linearly.
  at(columns, time) {
    const { times } = this.motion;
    const i = Math.min(row_at(times, time), times.length - 2);
    const s = Math.min(Math.max((time - times[i]) / (times[i + 1] - times[i]), 0), 1);
    return columns.map((column) => column[i] + s * (column[i + 1] - column[i]));
  }

  move_to(time) {
    const row = this.at(this.motion.poses, time);
    this.parts.forEach((part, p) => {
      part.position.fromArray(row, 7 * p);
      part.quaternion.fromArray(row, 7 * p + 3).normalize();
    });
    if (this.liquid) this.tilt(...this.at(this.motion.waves, time));
    if (!this.grains) return;
    const positions = this.at(this.motion.grains, time);
    const X = new THREE.Matrix4();
    for (let i = 0; i < this.grains.count; ++i)
      this.grains.setMatrixAt(i, X.makeTranslation(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]));
    this.grains.instanceMatrix.needsUpdate = true;
  }

  dispose() {
    this.group.removeFromParent();
    this.trail.geometry.dispose();
    this.liquid?.geometry.dispose();
    this.grains?.dispose();
  }
}
