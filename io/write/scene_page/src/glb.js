// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the scene's GLB: JSON, and accessors out of buffer views that may be packed as EXT_meshopt_compression says.

const arrays = { 5120: Int8Array, 5121: Uint8Array, 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array };
const components = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };

export function parseGlb(bytes, decoder) {
  const words = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (words.getUint32(0, true) !== 0x46546c67) throw new Error('no GLB');
  const length = words.getUint32(12, true);
  const json = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length)));
  const chunk = bytes.subarray(28 + length);
  const views = new Map();

  function view(index) {
    if (!views.has(index)) {
      const { byteOffset = 0, byteLength, extensions } = json.bufferViews[index];
      const packed = extensions?.EXT_meshopt_compression;
      if (packed) {
        const { count, byteStride, mode, filter } = packed;
        const target = new Uint8Array(count * byteStride);
        decoder.decodeGltfBuffer(target, count, byteStride,
                                 chunk.subarray(packed.byteOffset, packed.byteOffset + packed.byteLength), mode, filter);
        views.set(index, target);
      } else {
        views.set(index, chunk.slice(byteOffset, byteOffset + byteLength));
      }
    }
    return views.get(index);
  }

  /** The numbers of an accessor, one after the other. */
  function accessor(index) {
    const { bufferView, byteOffset = 0, componentType, count, type } = json.accessors[index];
    const n = components[type];
    const Type = arrays[componentType];
    const bytes_ = view(bufferView);
    const stride = json.bufferViews[bufferView].byteStride ?? n * Type.BYTES_PER_ELEMENT;
    if (stride === n * Type.BYTES_PER_ELEMENT) return new Type(bytes_.buffer, bytes_.byteOffset + byteOffset, count * n);
    const apart = new Type(bytes_.buffer, bytes_.byteOffset, bytes_.byteLength / Type.BYTES_PER_ELEMENT);
    const step = stride / Type.BYTES_PER_ELEMENT;
    const first = byteOffset / Type.BYTES_PER_ELEMENT;
    const result = new Type(count * n);
    for (let i = 0; i < count; ++i) {
      for (let k = 0; k < n; ++k) result[i * n + k] = apart[first + i * step + k];
    }
    return result;
  }

  /** Positions of a node's mesh in metres, quantization undone: the node above all has it. */
  function positions(node) {
    const data = accessor(json.meshes[node.mesh].primitives[0].attributes.POSITION);
    const { scale = [1, 1, 1], translation = [0, 0, 0] } = json.nodes.find(({ children }) => children) ?? {};
    return Float32Array.from(data, (value, i) => value * scale[i % 3] + translation[i % 3]);
  }
  return { json, accessor, positions };
}

export async function unpack(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
