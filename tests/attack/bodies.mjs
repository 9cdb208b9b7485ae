// Bodies of a few megabytes, each made so that one step of the work on it is as expensive as it can be made.

// "f(0),f(1),…" without an array of a million strings in between.
function list(count, f) {
  const pieces = [];
  for (let begin = 0; begin < count; begin += 10_000) {
    const piece = [];
    for (let i = begin; i < Math.min(count, begin + 10_000); ++i) piece.push(f(i));
    pieces.push(piece.join(','));
  }
  return pieces.join(',');
}
const flatPoints = (count) => list(count, (i) => `${i % 1000},${Math.floor(i / 1000)},${i % 7}`);
const json = (text) => Buffer.from(text, 'latin1');

export function glb(document, bin = Buffer.alloc(0)) {
  const text = Buffer.from(typeof document === 'string' ? document : JSON.stringify(document), 'latin1');
  const chunk = (type, bytes, filler) => {
    const padded = Buffer.concat([bytes, Buffer.alloc(-bytes.length & 3, filler)]);
    const header = Buffer.alloc(8);
    header.writeUInt32LE(padded.length, 0);
    header.write(type, 4, 'latin1');
    return Buffer.concat([header, padded]);
  };
  const chunks = [chunk('JSON', text, ' ')];
  if (bin.length > 0) chunks.push(chunk('BIN\0', bin, 0));
  const header = Buffer.from('glTF\x02\0\0\0\0\0\0\0', 'latin1');
  header.writeUInt32LE(12 + chunks.reduce((sum, { length }) => sum + length, 0), 8);
  return Buffer.concat([header, ...chunks]);
}

const triangle = Buffer.from(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]).buffer);
const trianglePositions = { bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [0, 0, 0], max: [1, 1, 0] };

// A GLB around one triangle; `more` are further members of the document's text, `primitives` the text of the mesh's.
function triangleGlb({ more = '', primitives = '{"attributes":{"POSITION":0}}', accessors = '', views = '', bin = Buffer.alloc(0) }) {
  return glb(
    `{"asset":{"version":"2.0"},"buffers":[{"byteLength":${triangle.length + bin.length}}],` +
      `"bufferViews":[{"buffer":0,"byteLength":36}${views}],"accessors":[${JSON.stringify(trianglePositions)}${accessors}],` +
      `"meshes":[{"primitives":[${primitives}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0${more}}`,
    Buffer.concat([triangle, bin]));
}

// --- work without end -----------------------------------------------------------------------------------------

// Pairs whose keys (lower << 32 | higher) are congruent modulo a size that std::unordered_set grows to.
export function creasesInOneBucket(pairs = 100_000, buckets = 172_933) {
  const step = 2 ** 32 % buckets;
  const other = (low) => {
    const high = (buckets - (low * step) % buckets) % buckets;
    return high > low ? high : high + buckets;
  };
  return json(`{"points":[${list(2 * buckets, () => '0,0,0')}],"faceVertexIndices":[0,1,2],` +
    `"creaseIndices":[${list(pairs, (i) => `${i},${other(i)}`)}],` +
    `"creaseLengths":[${list(pairs, () => 2)}],"creaseSharpnesses":[${list(pairs, () => 1)}]}`);
}

export function sparseAccessorsOnOneList(accessors = 12_000, indices = 1_000_000) {
  const numbers = Buffer.from(Uint32Array.from({ length: indices }, (_, i) => i).buffer);
  const sparse = `,{"componentType":5121,"type":"SCALAR","count":${indices},"sparse":{"count":${indices},` +
    `"indices":{"bufferView":1,"componentType":5125},"values":{"bufferView":2}}}`;
  return triangleGlb({
    views: `,{"buffer":0,"byteOffset":36,"byteLength":${4 * indices}},{"buffer":0,"byteOffset":${36 + 4 * indices},"byteLength":${indices}}`,
    accessors: sparse.repeat(accessors),
    bin: Buffer.concat([numbers, Buffer.alloc(indices)]),
  });
}

export function manyAttributes(count = 50_000) {
  return triangleGlb({ primitives: `{"attributes":{"POSITION":0,${list(count, (i) => `"_A${i}":0`)}}}` });
}

export function manyRootMembers(members = 500_000, primitives = 10_000) {
  return triangleGlb({ more: `,${list(members, (i) => `"a${i}":0`)}`, primitives: list(primitives, () => '{"attributes":{"POSITION":0}}') });
}

export function manyPrimitives(count) {
  return triangleGlb({ primitives: list(count, () => '{"attributes":{"POSITION":0}}') });
}

export function manyGltfMeshes(count = 100_000) {
  return glb(`{"asset":{"version":"2.0"},"buffers":[{"byteLength":36}],"bufferViews":[{"buffer":0,"byteLength":36}],` +
    `"accessors":[${JSON.stringify(trianglePositions)}],"meshes":[${list(count, () => '{"primitives":[{"attributes":{"POSITION":0}}]}')}],` +
    `"nodes":[${list(count, (i) => `{"mesh":${i}}`)}]}`, triangle);
}

export function nodesInOneChain(count = 200_000) {
  return glb(
    `{"asset":{"version":"2.0"},"buffers":[{"byteLength":36}],"bufferViews":[{"buffer":0,"byteLength":36}],` +
      `"accessors":[${JSON.stringify(trianglePositions)}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],` +
      `"nodes":[${list(count, (i) => (i + 1 < count ? `{"mesh":0,"children":[${i + 1}]}` : '{"mesh":0}'))}],"scenes":[{"nodes":[0]}]}`, triangle);
}

// Tips 0 and 1 over a ring; the very last face joins the tips, and one crease runs between them all the time.
export function creaseBetweenTips(faces = 100_000, points = 2_000_000) {
  const ring = (i) => 2 + (i % faces);
  return json(`{"points":[${flatPoints(faces + 2)}],` +
    `"faceVertexIndices":[${list(faces, (i) => `0,${ring(i)},${ring(i + 1)},1,${ring(i + 1)},${ring(i)}`)},0,1,2],` +
    `"creaseIndices":[${'0,1,'.repeat(points / 2).slice(0, -1)}],"creaseLengths":[${points}],"creaseSharpnesses":[1]}`);
}

export function facesOnOneEdge(faces = 400_000) {
  return json(`{"points":[${flatPoints(faces + 2)}],"faceVertexIndices":[${list(faces, (i) => `0,1,${i + 2}`)}]}`);
}

export function fan(faces = 65_535) {
  return json(`{"points":[${flatPoints(faces + 1)}],"faceVertexIndices":[${list(faces, (i) => `0,${i + 1},${((i + 1) % faces) + 1}`)}]}`);
}

// Two faces of so many corners, back to back.
export function pillow(corners, seams = false) {
  const around = Array.from({ length: corners }, (_, i) => i);
  const primvars = !seams ? {} : { st: {
    interpolation: 'faceVarying', elementSize: 2, values: Array.from({ length: 4 * corners }, (_, i) => i % 7) } };
  return json(JSON.stringify({
    points: around.flatMap((i) => [Math.cos(i), Math.sin(i), i % 3]), faceVertexCounts: [corners, corners],
    faceVertexIndices: [...around, ...around.toReversed()], primvars }));
}

export function manyPrimvars(count = 20_000) {
  return json(`{"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,1,2],"primvars":{` +
    `${list(count, (i) => `"p${i}":{"interpolation":"vertex","values":[1,2,3]}`)}}}`);
}

export function manyMeshes(count = 100_000) {
  return json(`{"meshes":[${list(count, () => '{"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,1,2]}')}]}`);
}

export function manyCurves(count = 200_000) {
  return json(`{"curves":[${list(count, () => '{"points":[[0,0],[1,2],[3,2],[4,0]]}')}]}`);
}

export function degenerateFaces(count = 1_000_000) {
  return json(`{"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,1,2,${'1,1,1,'.repeat(count).slice(0, -1)}]}`);
}

export function manyMembers(count = 1_000_000) {
  return json(`{${list(count, (i) => `"m${i}":0`)},"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,1,2]}`);
}

// --- honest work of seconds -----------------------------------------------------------------------------------

export function sheet(columns, rows = columns) {
  const corner = (i) => {
    const a = Math.floor(i / columns) * (columns + 1) + (i % columns), c = a + columns + 1;
    return `${a},${a + 1},${c + 1},${a},${c + 1},${c}`;
  };
  const point = (i) => `${i % (columns + 1)},${Math.floor(i / (columns + 1))},${i % 3}`;
  return json(`{"points":[${list((columns + 1) * (rows + 1), point)}],"faceVertexIndices":[${list(columns * rows, corner)}]}`);
}

export function closestPoints(count = 100_000) {
  return json(`{"curves":[{"points":[${list(200, (i) => `[${i},${(i * 37) % 11},${(i * 17) % 5}]`)}]}],` +
    `"closestTo":[${list(count, (i) => `[${i % 200},${i % 13},${i % 7}]`)}]}`);
}

export const converge = (levels = 24) => json(`{"curves":[{"points":[[0,0],[1,2],[3,2],[4,0]]}],"convergence":${levels}}`);

// --- memory ---------------------------------------------------------------------------------------------------

// A sheet whose text has about so many bytes.
export function sheetOfBytes(bytes) {
  const side = Math.round(Math.sqrt(bytes / 52));
  return sheet(side);
}

export const flatCurve = (points) => json(`{"curves":[{"points":[${list(points, (i) => `[${i % 10}]`)}]}]}`);

// A sheet of triangles with positions and `attributes` further attributes of four numbers. `torn`: every corner is a vertex of
// its own, so that no value of an attribute belongs to two faces. `shared`: all attributes are the same bytes, one for each
// number, which become much more than a byte in memory.
export function glbWithAttributes(attributes, bytes, { torn = false, shared = false } = {}) {
  const perVertex = 12 + (shared ? 4 : 16 * attributes);
  const side = Math.floor(Math.sqrt(bytes / (torn ? 6 * perVertex : perVertex + 24)));
  const corners = new Uint32Array(6 * side * side);
  for (let i = 0; i < side * side; ++i) {
    const a = Math.floor(i / side) * (side + 1) + (i % side), c = a + side + 1;
    corners.set([a, a + 1, c + 1, a, c + 1, c], 6 * i);
  }
  const points = torn ? corners : Uint32Array.from({ length: (side + 1) ** 2 }, (_, i) => i);
  const positions = new Float32Array(3 * points.length);
  points.forEach((point, i) => positions.set([point % (side + 1), Math.floor(point / (side + 1)), point % 3], 3 * i));
  const values = new (shared ? Uint8Array : Float32Array)(4 * points.length).map((_, i) => (i * 7919) % 251);

  const bufferViews = [], accessors = [], parts = [];
  let offset = 0;
  const accessor = (array, more) => {
    const part = Buffer.from(array.buffer);
    bufferViews.push({ buffer: 0, byteOffset: offset, byteLength: part.length });
    parts.push(part);
    offset += part.length;
    return accessors.push({ bufferView: bufferViews.length - 1, count: points.length, ...more }) - 1;
  };
  const valueAccessor = () => accessor(values, { type: 'VEC4', componentType: shared ? 5121 : 5126, normalized: shared });
  const primitive = { attributes: { POSITION: accessor(positions, { type: 'VEC3', componentType: 5126, min: [0, 0, 0], max: [side, side, 2] }) } };
  if (!torn) primitive.indices = accessor(corners, { type: 'SCALAR', componentType: 5125, count: corners.length });
  const first = valueAccessor();
  for (let i = 0; i < attributes; ++i) primitive.attributes[`_V${i}`] = shared || i === 0 ? first : valueAccessor();
  return glb({
    asset: { version: '2.0' }, buffers: [{ byteLength: offset }], bufferViews, accessors,
    meshes: [{ primitives: [primitive] }], nodes: [{ mesh: 0 }],
  }, Buffer.concat(parts));
}

// A quarter of a kilobyte that stands for half a gigabyte of zeros.
export function elementsOfNothing(count = 44_000_001) {
  return glb({
    asset: { version: '2.0' },
    accessors: [{ componentType: 5126, count, type: 'VEC3', min: [0, 0, 0], max: [0, 0, 0] }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
    nodes: [{ mesh: 0 }],
  });
}

export const longKey = (bytes) => json(`{"${'k'.repeat(bytes)}":0,"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,1,2]}`);

// --- hundreds of refusals -------------------------------------------------------------------------------------

// Bodies that are refused after something has been allocated for them, and a few that are not.
export const hostile = () => [
  json(`{"points":[${flatPoints(300_000)}],"faceVertexIndices":[0,1,300000]}`),
  json(`{"points":[${flatPoints(300_000)}`),
  longKey(5_000_000),
  json(`{"points":[${'[],'.repeat(1_000_000)}[]],"faceVertexIndices":[0,1,2]}`),
  json(`{"extra":${'['.repeat(1_000_000)}`),
  manyMembers(300_000),
  json(`{"meshes":[${list(50_000, () => '{"points":[0,0,0,1,0,0,0,1,0],"faceVertexIndices":[0,1,2]}')},{}]}`),
  manyAttributes(20_000),
  glbWithAttributes(8, 6_000_000).subarray(0, 5_000_000),
  triangleGlb({ more: `,"extras":[${'{},'.repeat(500_000)}{}],"nonsense` }),
  json(`{"curves":[{"points":[${list(1_000_000, (k) => `[${k % 10}]`)},[1,2]]}]}`),
  elementsOfNothing(4_000_002),
];
