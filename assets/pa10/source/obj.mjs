// A solid as OBJ text: metres, one normal per corner, smooth across edges below the crease angle.
const CREASE_COS = 0.8191520442889918;  // 35 deg
const FLAT_COS = 0.99999;               // faces closer than 0.26 deg count as one facet

const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** @return the OBJ text and its number of triangles; `solid` is in millimetres */
export function objText(solid, material, materialFile) {
  const faces = trianglesOf(solid);
  const normals = cornerNormals(faces);
  const v = table('v', 5), vn = table('vn', 4);
  const f = faces.map(({ corners }, i) => 'f ' + corners.map((corner, k) =>
    `${v.index(corner.map(x => x / 1000))}//${vn.index(normals[i][k])}`).join(' '));
  const text = [`mtllib ${materialFile}`, ...v.lines, ...vn.lines, `usemtl ${material}`, ...f, ''].join('\n');
  return { text, triangles: faces.length };
}

function trianglesOf(solid) {
  const { vertProperties, numProp, triVerts } = solid.getMesh();
  const point = i => Array.from(vertProperties.subarray(i * numProp, i * numProp + 3), grid);
  const faces = [];
  for (let t = 0; t < triVerts.length; t += 3) {
    const ids = Array.from(triVerts.subarray(t, t + 3));
    const corners = ids.map(point);
    const n = cross(sub(corners[1], corners[0]), sub(corners[2], corners[0]));
    const length = Math.sqrt(dot(n, n));
    faces.push({ corners, area: length, normal: length > 0 ? n.map(x => x / length) : [0, 0, 0] });
  }
  return faces;
}

// To 0.01 mm, as written, so that what is checked here is what is in the file.
const grid = x => Math.round(x * 100) / 100;

// Each facet that meets a corner within the crease angle counts once, by the root of its whole area:
// large flat faces stay flat up to their fillets, and strips cut short do not streak a barrel.
function cornerNormals(faces) {
  const around = new Map();
  faces.forEach((face, i) => face.corners.forEach(corner => {
    const key = corner.join();
    around.set(key, [...(around.get(key) ?? []), i]);
  }));
  const facet = facets(faces, around);
  const facetArea = new Map();
  faces.forEach((face, i) => facetArea.set(facet[i], (facetArea.get(facet[i]) ?? 0) + face.area));
  return faces.map(face => face.corners.map(corner => {
    const sum = [0, 0, 0], seen = new Set();
    for (const i of around.get(corner.join())) {
      if (seen.has(facet[i]) || dot(faces[i].normal, face.normal) < CREASE_COS) continue;
      seen.add(facet[i]);
      for (let k = 0; k < 3; ++k) sum[k] += faces[i].normal[k] * Math.sqrt(facetArea.get(facet[i]));
    }
    const length = Math.sqrt(dot(sum, sum));
    return length > 0 ? sum.map(x => x / length) : [0, 0, 1];
  }));
}

// Joins faces that share an edge and a plane; returns each face's facet.
function facets(faces, around) {
  const parent = faces.map((_, i) => i);
  const root = i => { while (parent[i] !== i) i = parent[i] = parent[parent[i]]; return i; };
  faces.forEach((face, i) => face.corners.forEach((corner, k) => {
    const next = face.corners[(k + 1) % 3].join();
    for (const j of around.get(corner.join()))
      if (j !== i && dot(face.normal, faces[j].normal) > FLAT_COS && faces[j].corners.some(c => c.join() === next))
        parent[root(i)] = root(j);
  }));
  return parent.map((_, i) => root(i));
}

function table(keyword, digits) {
  const lines = [], known = new Map();
  const number = x => String(Number(x.toFixed(digits)) + 0);
  return {
    lines,
    index(values) {
      const line = `${keyword} ${values.map(number).join(' ')}`;
      if (!known.has(line)) known.set(line, lines.push(line));
      return known.get(line);
    },
  };
}
