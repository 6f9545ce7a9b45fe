// The 3-D picture: arms of all methods in one place, one solid and the others ghosts, or side by side.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { Arm } from './arm.js';
import { by_id, fill, make } from './dom.js';
import { row_at } from './data.js';
import { part_geometries, unpack_meshes } from './shapes.js';

const view_angle = 33; // [deg]
const close_distance = 0.75; // [m]

const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// A floor that has no edge.
function fading() {
  const canvas = make('canvas', { width: 256, height: 256 });
  const context = canvas.getContext('2d');
  const light = context.createRadialGradient(128, 128, 0, 128, 128, 128);
  light.addColorStop(0, '#fff');
  light.addColorStop(0.55, '#fff');
  light.addColorStop(1, '#000');
  context.fillStyle = light;
  context.fillRect(0, 0, 256, 256);
  return new THREE.CanvasTexture(canvas);
}

export class View {
  constructor(canvas, report) {
    this.report = report;
    this.canvas = canvas;
    this.arms = [];
    this.hidden = new Set();
    this.layout = 'ghosts';
    this.time = 0;
    this.drawn = 0;
    try {
      this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    } catch {
      this.renderer = null;
      return;
    }
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.shadowMap.enabled = true;
    this.renderer.toneMapping = THREE.ACESFilmicToneMapping;
    this.renderer.toneMappingExposure = 1.15;
    this.camera = new THREE.PerspectiveCamera(view_angle, 1, 0.1, 20);
    this.camera.up.set(0, 0, 1);
    this.build_stage();
    this.build_controls();
    new ResizeObserver(() => this.draw()).observe(canvas.parentElement);
  }

  build_stage() {
    this.stage = new THREE.Scene();
    const sun = new THREE.DirectionalLight(0xffffff, 2.4);
    sun.position.set(1.4, -1.6, 2.8);
    sun.target.position.set(0.3, 0, 0.3);
    sun.castShadow = true;
    sun.shadow.mapSize.set(2048, 2048);
    sun.shadow.radius = 6;
    sun.shadow.bias = -0.0006;
    sun.shadow.normalBias = 0.004;
    Object.assign(sun.shadow.camera, { left: -1.4, right: 1.4, top: 1.6, bottom: -1.2, near: 0.5, far: 7 });
    const fill_light = new THREE.DirectionalLight(0xdfe8ff, 0.7);
    fill_light.position.set(-2, 1.5, 1.2);
    this.floor = new THREE.Mesh(new THREE.CircleGeometry(1.7, 128), new THREE.MeshStandardMaterial({ roughness: 1, transparent: true, alphaMap: fading() }));
    this.floor.renderOrder = -2;
    this.floor.position.z = -0.002;
    this.floor.receiveShadow = true;
    this.stage.add(new THREE.HemisphereLight(0xffffff, 0x8d8f96, 1.5), sun, sun.target, fill_light, this.floor);
  }

  build_controls() {
    this.canvas.addEventListener('wheel', (event) => (this.controls.enableZoom = event.ctrlKey || event.metaKey), { capture: true });
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.addEventListener('change', () => this.draw());
    this.canvas.style.touchAction = 'pan-y';
    this.canvas.addEventListener('keydown', (event) => {
      const turn = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] }[event.key];
      if (!turn) return;
      event.preventDefault();
      this.turn(...turn);
    });
  }

  turn(around, up) {
    const out = this.camera.position.clone().sub(this.controls.target);
    const at = new THREE.Spherical().setFromVector3(new THREE.Vector3(out.x, out.z, -out.y));
    at.theta += around;
    at.phi = Math.min(Math.max(at.phi + up, 0.05), 1.7);
    const turned = new THREE.Vector3().setFromSpherical(at);
    this.camera.position.set(turned.x, -turned.z, turned.y).add(this.controls.target);
    this.controls.update();
    this.draw();
  }

  async unpack(data, pack) {
    if (!data.stage || !this.renderer) return;
    this.meshes ??= await unpack_meshes(this.report.meshes);
    data.geometries = data.stage.parts.map((part) => part_geometries(part, this.meshes));
    for (const run of data.runs) {
      const { motion } = run;
      if (!motion) continue;
      for (const name of ['poses', 'tool', 'grains', 'waves']) if (motion[name]) motion[name] = pack.columns(motion[name]);
      motion.times = motion.running.map((_, i) => i / data.stage.frame_rate);
    }
  }

  show(data, hidden) {
    const moved = this.data !== data;
    this.data = data;
    this.hidden = hidden;
    for (const arm of this.arms) arm.dispose();
    this.arms = [];
    const { arm } = data.shown.at(-1);
    const runs = data.shown.filter((run) => run.arm === arm);
    const shown = runs.filter((run) => this.renderer && run.motion);
    this.tell_of(data, runs, shown);
    if (!shown.length) return;
    this.arms = shown.map((run) => new Arm(data.stage, run, data.geometries));
    for (const arm of this.arms) this.stage.add(arm.group);
    const kept = !moved && shown.find((run) => run.method === this.solid);
    const first = kept || (shown.find((run) => run.method === 'dmp3') ?? shown.at(-1));
    this.solid = first.method;
    fill(by_id('solid'), ...shown.map((run) => make('option', { value: run.method, selected: run === first }, run.method)));
    if (moved) this.reset_camera();
    this.repaint();
  }

  tell_of(data, runs, shown) {
    const missing = runs.filter((run) => !shown.includes(run)).map((run) => run.method);
    const words = !this.renderer
      ? 'This browser has no WebGL: the arm is not shown.'
      : data.why_no_arm
        ? `The arm is not shown: ${data.why_no_arm}`
      : missing.length
        ? `There is no replay of ${missing.join(', ')}: ${shown.length ? 'not shown here' : 'the arm is not shown'}.`
        : '';
    by_id('no-view').textContent = words;
    by_id('no-view').hidden = !words;
    by_id('replay').classList.toggle('empty', !shown.length);
    by_id('replay').classList.toggle('alone', shown.length === 1);
  }

  // Near the tool of the solid arm, going where it goes.
  set_close(on) {
    if (!this.arms.length) return;
    this.reset_camera();
    by_id('close-up').setAttribute('aria-pressed', String(on));
    this.close = on;
    if (!on) return;
    const out = this.camera.position.clone().sub(this.controls.target).setLength(close_distance);
    this.controls.target.copy(this.tool());
    this.camera.position.copy(this.controls.target).add(out);
    this.controls.update();
    this.draw();
  }

  tool() {
    const arm = this.visible().find(({ run }) => run.method === this.solid) ?? this.arms[0];
    return new THREE.Vector3(...arm.at(arm.motion.tool, this.time));
  }

  reset_camera() {
    this.close = false;
    by_id('close-up').setAttribute('aria-pressed', 'false');
    const { from, at } = this.data.camera;
    this.camera.position.fromArray(from);
    this.controls.target.fromArray(at);
    this.controls.update();
    this.draw();
  }

  repaint() {
    if (!this.renderer) return;
    this.stage.background = new THREE.Color(css('--stage'));
    this.floor.material.color.set(css('--floor'));
    for (const arm of this.arms) arm.colour(css(`--${arm.run.method}`));
    this.arrange();
  }

  set_layout(layout) {
    this.layout = layout;
    by_id('solid-label').hidden = layout === 'side';
    this.arrange();
  }

  set_solid(method) {
    this.solid = method;
    this.arrange();
  }

  set_hidden(hidden) {
    this.hidden = hidden;
    this.arrange();
  }

  visible() {
    return this.arms.filter((arm) => !this.hidden.has(arm.run.method));
  }

  arrange() {
    const visible = this.visible();
    const solid = visible.find((arm) => arm.run.method === this.solid) ?? visible[0];
    for (const arm of this.arms) {
      arm.group.visible = visible.includes(arm);
      arm.set_ghost(this.layout === 'ghosts' && arm !== solid);
    }
    const labelled = this.layout === 'side' ? visible : [];
    const [across, down] = this.grid(labelled.length);
    fill(by_id('labels'), ...labelled.map((arm, i) =>
      make('span', { class: 'method', style: `--method: var(--${arm.run.method}); left: ${(100 * (i % across)) / across}%; top: ${(100 * Math.floor(i / across)) / down}%` }, arm.run.method)));
    this.draw();
  }

  at(time) {
    this.time = time;
    for (const arm of this.arms) arm.move_to(time);
    if (this.close) {
      const moved = this.tool().sub(this.controls.target);
      this.controls.target.add(moved);
      this.camera.position.add(moved);
    }
    this.draw();
  }

  // Names of the primitives that run at a time.
  doing(time) {
    if (!this.arms.length) return '';
    const { primitives } = this.data.stage;
    const names = new Set(this.arms.map(({ motion }) => primitives[motion.running[row_at(motion.times, time)]] ?? 'waiting to start'));
    const on = this.data.arms.length > 1 ? ` on the ${this.data.shown.at(-1).arm} arm` : '';
    return `Running${on}: ${[...names].join(', ')}`;
  }

  grid(count) {
    if (count <= 1) return [1, 1];
    return count === 2 ? [2, 1] : [2, Math.ceil(count / 2)];
  }

  // Soon, and once for all that has changed by then.
  draw() {
    if (!this.renderer || this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw_now();
    });
  }

  draw_now() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (!width || !height || !this.arms.length) return;
    const size = this.renderer.getSize(new THREE.Vector2());
    if (size.x !== width || size.y !== height) this.renderer.setSize(width, height, false);
    if (this.layout === 'side') this.draw_side_by_side(width, height);
    else this.draw_into(0, 0, width, height);
    ++this.drawn;
  }

  draw_side_by_side(width, height) {
    const visible = this.visible();
    const [across, down] = this.grid(visible.length);
    const [w, h] = [width / across, height / down];
    visible.forEach((arm, i) => {
      for (const other of visible) other.group.visible = other === arm;
      this.draw_into((i % across) * w, height - (Math.floor(i / across) + 1) * h, w, h);
    });
    for (const arm of visible) arm.group.visible = true;
  }

  draw_into(x, y, width, height) {
    this.renderer.setViewport(x, y, width, height);
    this.renderer.setScissor(x, y, width, height);
    this.renderer.setScissorTest(true);
    this.camera.aspect = width / height;
    // What fits a square fits a narrow picture, too.
    this.camera.fov = view_angle * Math.min(1.6, Math.max(1, height / width));
    this.camera.updateProjectionMatrix();
    this.renderer.render(this.stage, this.camera);
  }

  // Drawn now, as bytes RGBA of 64 × 64 pixels.
  picture() {
    this.draw_now();
    const small = make('canvas', { width: 64, height: 64 });
    const context = small.getContext('2d');
    context.drawImage(this.canvas, 0, 0, 64, 64);
    return [...context.getImageData(0, 0, 64, 64).data];
  }

  state() {
    return { arms: this.visible().length, drawn: this.drawn, layout: this.layout };
  }
}
