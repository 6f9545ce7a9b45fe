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

// J1(x) for x up to 2, to 1e-5.
const bessel = (x) => (x / 2) * (1 - (x * x) / 8 + x ** 4 / 192 - x ** 6 / 9216 + x ** 8 / 737280);
const first_zero = 1.8412; // of its derivative

// A liquid in an upright glass: bottom, wall, and the surface as its first mode shapes it, by the heights [m] that a wave has
// at the wall along x and y.
export function liquid_geometry({ radius, depth }) {
  const around = 48;
  const rings = [0.999, 0.75, 0.5, 0.25, 0];
  const R = 0.985 * radius;
  const bottom = [];
  const surface = [];
  for (let i = 0; i <= around; ++i) {
    const a = (2 * Math.PI * i) / around;
    bottom.push(R * Math.cos(a), R * Math.sin(a), 0.001);
    for (const share of rings) surface.push(share * R * Math.cos(a), share * R * Math.sin(a), depth);
  }
  const first = around + 1;
  const wall_or_surface = (i, k) => (k < 0 ? i : first + i * rings.length + k);
  const index = [];
  for (let i = 0; i < around; ++i)
    for (let k = -1; k < rings.length - 1; ++k) {
      const corners = [[i, k], [i + 1, k], [i, k + 1], [i + 1, k + 1]].map(([j, ring]) => wall_or_surface(j, ring));
      index.push(corners[0], corners[1], corners[2], corners[1], corners[3], corners[2]);
    }
  const geometry = new THREE.BufferGeometry();
  const positions = new THREE.BufferAttribute(new Float32Array([...bottom, ...surface]), 3);
  geometry.setAttribute('position', positions);
  geometry.setIndex(index);
  const shape = rings.map((share) => bessel(first_zero * share) / bessel(first_zero));
  const tilt = (wave_x, wave_y) => {
    for (let i = 0; i <= around; ++i) {
      const a = (2 * Math.PI * i) / around;
      const wave = wave_x * Math.cos(a) + wave_y * Math.sin(a);
      rings.forEach((_, k) => positions.setZ(wall_or_surface(i, k), Math.max(0.002, depth + shape[k] * wave)));
    }
    positions.needsUpdate = true;
    geometry.computeVertexNormals();
  };
  tilt(0, 0);
  return { geometry, tilt };
}
