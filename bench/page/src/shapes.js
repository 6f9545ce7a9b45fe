// Geometry of what stands in a scene: one per part, its shapes placed, scaled and coloured.
import * as THREE from 'three';
import { mergeGeometries, mergeVertices, toCreasedNormals } from 'three/addons/utils/BufferGeometryUtils.js';
import { Pack } from './data.js';

// The mesh files' pieces, {positions, triangles, colour}, unpacked once.
export async function unpack_meshes({ pack, meshes }) {
  const numbers = await Pack.open(pack);
  return meshes.map(({ positions, triangles, colour }) => {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(interleaved(numbers.columns(positions), Float32Array), 3));
    geometry.setIndex(new THREE.BufferAttribute(interleaved(numbers.columns(triangles), Uint32Array), 1));
    geometry.computeVertexNormals();
    return { geometry, colour };
  });
}

function interleaved(columns, Type) {
  const values = new Type(columns.length * columns[0].length);
  columns.forEach((column, c) => column.forEach((value, i) => (values[i * columns.length + c] = value)));
  return values;
}

// An open glass or bottle: its wall's profile, turned about z.
function vessel_geometry({ radius, height, wall }) {
  const R = radius + wall;
  const profile = [[0, 0], [R, 0], [R, height], [radius, height], [radius, wall], [0, wall]];
  const geometry = new THREE.LatheGeometry(profile.map(([r, z]) => new THREE.Vector2(r, z)), 64).rotateX(Math.PI / 2);
  geometry.deleteAttribute('uv');
  geometry.deleteAttribute('normal');
  const sharp = toCreasedNormals(geometry, 0.6);
  return { geometry: mergeVertices(sharp), colour: [0.72, 0.84, 0.92, 0.32] };
}

function pieces({ type, size, meshes, colour }, files) {
  if (type === 'mesh') return meshes.map((i) => ({ geometry: files[i].geometry.clone(), colour: colour ?? files[i].colour }));
  const geometry = {
    box: () => new THREE.BoxGeometry(...size),
    cylinder: () => new THREE.CylinderGeometry(size[0], size[0], size[2], 48).rotateX(Math.PI / 2),
    sphere: () => new THREE.SphereGeometry(size[0], 32, 20),
  }[type]();
  geometry.deleteAttribute('uv');
  return [{ geometry, colour }];
}

function placed(visual, files) {
  const [x, y, z, ...q] = visual.pose;
  const X = new THREE.Matrix4().compose(new THREE.Vector3(x, y, z), new THREE.Quaternion(...q), new THREE.Vector3(...(visual.scale ?? [1, 1, 1])));
  return pieces(visual, files).map(({ geometry, colour }) => coloured({ geometry: geometry.applyMatrix4(X), colour }));
}

function coloured({ geometry, colour }) {
  const rgb = new THREE.Color().setRGB(colour[0], colour[1], colour[2], THREE.SRGBColorSpace);
  const colours = new Float32Array(geometry.attributes.position.count * 3);
  for (let i = 0; i < colours.length; i += 3) rgb.toArray(colours, i);
  geometry.setAttribute('color', new THREE.BufferAttribute(colours, 3));
  return { geometry, alpha: colour[3] ?? 1 };
}

// [{geometry, alpha}] of a part: what is opaque, and what can be seen through.
export function part_geometries(part, files) {
  const all = part.visuals.flatMap((visual) => placed(visual, files));
  if (part.vessel) all.push(coloured(vessel_geometry(part.vessel)));
  const groups = [all.filter((p) => p.alpha >= 1), all.filter((p) => p.alpha < 1)];
  return groups
    .filter((group) => group.length)
    .map((group) => ({ geometry: mergeGeometries(group.map((p) => p.geometry)), alpha: Math.min(...group.map((p) => p.alpha)) }));
}

// A liquid in an upright glass: wall and surface, the surface tilted by `tilt(wave_x, wave_y)` [m at the wall].
export function liquid_geometry({ radius, depth }) {
  const around = 48;
  const R = 0.985 * radius;
  const positions = new Float32Array((2 * around + 2) * 3);
  const index = [];
  const bottom = 2 * around;
  const top = bottom + 1;
  for (let i = 0; i < around; ++i) {
    const next = (i + 1) % around;
    const a = (2 * Math.PI * i) / around;
    positions.set([R * Math.cos(a), R * Math.sin(a), 0.001, R * Math.cos(a), R * Math.sin(a), depth], 6 * i);
    index.push(2 * i, 2 * next, 2 * i + 1, 2 * next, 2 * next + 1, 2 * i + 1);
    index.push(bottom, 2 * next, 2 * i, top, 2 * i + 1, 2 * next + 1);
  }
  positions.set([0, 0, 0.001, 0, 0, depth], 3 * bottom);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
  geometry.setIndex(index);
  geometry.computeVertexNormals();
  const tilt = (wave_x, wave_y) => {
    for (let i = 0; i < around; ++i) {
      const a = (2 * Math.PI * i) / around;
      positions[6 * i + 5] = Math.max(0.002, depth + wave_x * Math.cos(a) + wave_y * Math.sin(a));
    }
    geometry.attributes.position.needsUpdate = true;
    geometry.computeVertexNormals();
  };
  return { geometry, tilt };
}
