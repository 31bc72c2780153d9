// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
// What is drawn: three.js objects for cuts, boreholes, barriers and the frame.
import {
  AmbientLight, BufferAttribute, BufferGeometry, Color, DataTexture, DirectionalLight, DoubleSide, Group, LineBasicMaterial,
  LineSegments, LinearFilter, Mesh, MeshBasicMaterial, MeshLambertMaterial, NearestFilter, PerspectiveCamera, RGBAFormat,
  Raycaster, Scene, ShaderMaterial, SphereGeometry, SRGBColorSpace, Vector2, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

import { colorAt, missing } from './scale.js';

/** Uniforms that all coloured things share. */
export const painting = {
  map: { value: null }, low: { value: 0 }, high: { value: 1 }, classes: { value: 0 }, reach: { value: 1 },
  cutoff: { value: missing }, grey: { value: new Vector3(0.78, 0.79, 0.81) },  // beyond the reach of the samples
};

const paint = `
  uniform sampler2D map; uniform float low, high, classes, reach, cutoff; uniform vec3 grey;
  vec3 paint(float value, bool known, float far) {
    if (!known || far >= reach - 1e-4) return grey;
    float t = classes > 0.0 ? (value + 0.5) / classes : high > low ? (value - low) / (high - low) : 0.5;
    return texture2D(map, vec2(clamp(t, 0.0, 1.0), 0.5)).rgb;
  }
  vec4 shown(vec3 color, float alpha) { return vec4(color, alpha); }
`;

/** Of cuts: the value is linear in each cell, or that of the nearest corner for classes. */
export function cutMaterial() {
  return new ShaderMaterial({
    uniforms: painting, side: DoubleSide,
    polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
    vertexShader: `
      attribute vec4 weights, levels; attribute float far;
      varying vec4 w, l; varying float f;
      void main() { w = weights; l = levels; f = far; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
    fragmentShader: `${paint}
      varying vec4 w, l; varying float f;
      void main() {
        bool known = all(greaterThan(l, vec4(-1e29)));
        float value = dot(w, l);
        if (classes > 0.0) {
          float most = max(max(w.x, w.y), max(w.z, w.w));
          value = w.x == most ? l.x : w.y == most ? l.y : w.z == most ? l.z : l.w;
          known = value > -1e29;
        }
        if (cutoff > -1e29 && (!known || value < cutoff)) discard;
        gl_FragColor = shown(paint(value, known, f), 1.0);
      }`,
  });
}

export function tubeMaterial() {
  return new ShaderMaterial({
    uniforms: painting, side: DoubleSide,
    vertexShader: `
      attribute float level; varying float l; varying float mark; attribute float picked;
      void main() { l = level; mark = picked; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
    fragmentShader: `${paint}
      varying float l; varying float mark;
      void main() {
        vec3 color = paint(classes > 0.0 ? floor(l + 0.5) : l, l > -1e29, -1.0);
        gl_FragColor = shown(mark > 0.5 ? mix(color, vec3(1.0, 0.2, 0.6), 0.35) : color, 1.0);
      }`,
  });
}

export function bodyMaterial(color, opacity) {
  return new MeshLambertMaterial({ color, opacity, transparent: opacity < 1, side: DoubleSide, depthWrite: opacity >= 1 });
}

/** A texture of a colour map's anchors, or of one texel a class. */
export function mapTexture(anchors, classColors = null) {
  const n = classColors ? classColors.length : 256;
  const data = new Uint8Array(4 * n);
  for (let i = 0; i < n; ++i) {
    const c = classColors ? new Color(classColors[i]).getRGB({}, SRGBColorSpace) : null;
    const rgb = c ? [c.r, c.g, c.b].map((x) => Math.round(255 * x)) : colorAt(anchors, i / (n - 1));
    data.set([...rgb, 255], 4 * i);
  }
  const texture = new DataTexture(data, n, 1, RGBAFormat);
  texture.magFilter = texture.minFilter = classColors ? NearestFilter : LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

export function geometryOf(attributes, index = null) {
  const geometry = new BufferGeometry();
  for (const [name, [array, size]] of Object.entries(attributes)) geometry.setAttribute(name, new BufferAttribute(array, size));
  if (index) geometry.setIndex(new BufferAttribute(index, 1));
  return geometry;
}

export const linesOf = (positions, color, opacity = 1) =>
  new LineSegments(geometryOf({ position: [positions, 3] }), new LineBasicMaterial({ color, opacity, transparent: opacity < 1 }));

export class View {
  constructor(canvas, box) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.scene = new Scene();
    this.world = new Group();  // stretched upwards as a whole
    this.scene.add(this.world);
    this.camera = new PerspectiveCamera(32, 1, 1, 10);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.lamp = new DirectionalLight('#fff', 1.6);
    this.scene.add(new AmbientLight('#fff', 1.7), this.lamp);
    this.box = box;
    this.stretch = 1;
    this.raycaster = new Raycaster();
    this.asked = false;
    this.onDraw = () => {};
    this.controls.addEventListener('change', () => this.draw());
  }

  get radius() {
    const [x, y, z] = [0, 1, 2].map((k) => this.box.max[k] - this.box.min[k]);
    return 0.5 * Math.hypot(x, y * this.stretch, z);
  }

  get middle() {
    const [x, y, z] = [0, 1, 2].map((k) => 0.5 * (this.box.max[k] + this.box.min[k]));
    return new Vector3(x, y * this.stretch, z);
  }

  setStretch(stretch) {
    const target = this.controls.target.clone();
    const eye = this.camera.position.clone().sub(target);
    target.y *= stretch / this.stretch;
    this.stretch = stretch;
    this.world.scale.y = stretch;
    this.controls.target.copy(target);
    this.camera.position.copy(target).add(eye);
    this.clipPlanes();
    this.draw();
  }

  clipPlanes() {
    this.camera.near = this.radius / 200;
    this.camera.far = this.radius * 60;
    this.camera.updateProjectionMatrix();
  }

  /** From a direction (azimuth of the eye from the middle, degrees; height above the horizon). */
  lookFrom(azimuth, height) {
    const a = azimuth * Math.PI / 180;
    const h = Math.min(89.9, height) * Math.PI / 180;
    const fit = Math.sin(this.camera.fov * Math.PI / 360) * Math.min(1, this.camera.aspect);
    const direction = new Vector3(Math.sin(a) * Math.cos(h), Math.sin(h), -Math.cos(a) * Math.cos(h));
    this.controls.target.copy(this.middle);
    let away = this.radius / fit;
    for (let round = 0; round < 4; ++round) {  // until the box just fits
      this.camera.position.copy(this.middle).addScaledVector(direction, away);
      this.clipPlanes();
      this.controls.update();
      this.camera.updateMatrixWorld();
      let most = 0;
      for (let i = 0; i < 8; ++i) {
        const corner = new Vector3(...[0, 1, 2].map((k) => (i >> k & 1 ? this.box.max : this.box.min)[k]));
        corner.y *= this.stretch;
        corner.project(this.camera);
        most = Math.max(most, Math.abs(corner.x), Math.abs(corner.y));
      }
      away *= most / 0.88;
    }
    this.draw();
  }

  resize(width, height) {
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** At the next frame, once. */
  draw() {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => { this.asked = false; this.drawNow(); });
  }

  drawNow() {
    this.lamp.position.copy(this.camera.position).add(new Vector3(0, this.radius, 0));
    this.renderer.render(this.scene, this.camera);
    this.onDraw();
  }

  ray(x, y) {
    const rect = this.renderer.domElement.getBoundingClientRect();
    const at = new Vector2(2 * (x - rect.left) / rect.width - 1, 1 - 2 * (y - rect.top) / rect.height);
    this.raycaster.setFromCamera(at, this.camera);
    return this.raycaster;
  }

  hits(x, y, objects) { return this.ray(x, y).intersectObjects(objects, false); }

  handle() {
    return new Mesh(new SphereGeometry(1, 16, 12), new MeshBasicMaterial({ color: '#e8572a' }));
  }
}
export { Color, Group, Mesh, Vector3 };
