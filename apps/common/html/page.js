// What the page does by itself: the list of all numbers, and the bodies to turn. No network, no storage.
"use strict";
(async () => {
  const byId = (id) => document.getElementById(id);

  const all = byId("all-numbers");
  if (all) all.textContent = byId("result").textContent.replace(/\\u003c/g, "<").trim();

  const stage = byId("stage");
  if (!stage) return;
  const say = (text) => {
    document.documentElement.dataset.viewer = text;
    byId("still-remark").textContent = text === "drawn" ? "" : text;
  };

  const unpacked = (id) => {
    const bytes = Uint8Array.from(atob(byId(id).textContent.trim()), (c) => c.charCodeAt(0));
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).text();
  };

  if (!byId("viewer-code")) return say("A still picture: vex was built without the library that turns bodies.");
  if (!("DecompressionStream" in window)) return say("A still picture: this browser is too old to turn the bodies.");
  const probe = document.createElement("canvas");
  if (!probe.getContext("webgl")) return say("A still picture: this browser has no WebGL to turn the bodies.");

  const code = document.createElement("script");
  code.textContent = await unpacked("viewer-code");
  document.head.append(code);
  const view = JSON.parse(await unpacked("viewer-data"));
  const { THREE } = window;
  const list = view.orientations;

  // Whole numbers are stored as differences (apps/common/html/pair_view.cpp).
  const indicesOf = (differences) => {
    let next = 0;
    return differences.map((d) => { const index = next - d; next = Math.max(next, index + 1); return index; });
  };
  const vectorsOf = (differences, unit) => {
    const numbers = Float32Array.from(differences);
    for (let k = 3; k < numbers.length; k += 1) numbers[k] += numbers[k - 3];
    return numbers.map((x) => x * unit);
  };
  for (const mesh of [view.a, view.b, ...list.map((one) => one.surface)]) {
    if (!mesh) continue;
    mesh.points = vectorsOf(mesh.points, mesh.unit);
    mesh.normals = vectorsOf(mesh.normals, 1 / 127);
    mesh.triangles = indicesOf(mesh.triangles);
    mesh.edges = indicesOf(mesh.edges);
  }

  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(28, 1, 0.01, 20);
  camera.up.set(0, 0, 1);
  const renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true });
  const canvas = renderer.domElement;
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", byId("pair-alt").textContent + " Drag, or press the arrow keys, to turn.");
  stage.append(canvas);

  scene.add(new THREE.HemisphereLight(0xffffff, 0x8899aa, 0.75));
  const lamp = new THREE.DirectionalLight(0xffffff, 0.55);
  lamp.position.set(-0.5, 0.9, 1);
  camera.add(lamp);
  scene.add(camera);

  const geometryOf = (mesh) => {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(mesh.points, 3));
    if (mesh.normals.length) geometry.setAttribute("normal", new THREE.BufferAttribute(mesh.normals, 3));
    geometry.setIndex(mesh.triangles);
    return geometry;
  };
  const linesOf = (mesh, color, opacity) => {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(mesh.points, 3));
    geometry.setIndex(mesh.edges);
    return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color, transparent: true, opacity }));
  };
  const bodyOf = (mesh, color, dark) => {
    const group = new THREE.Group();
    const material = new THREE.MeshPhongMaterial({
      color, side: THREE.DoubleSide, flatShading: !mesh.normals.length, shininess: 24, specular: 0x222222,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
    });
    if (mesh.triangles.length) group.add(new THREE.Mesh(geometryOf(mesh), material));
    const many = mesh.triangles.length > 1200;
    group.add(linesOf(mesh, mesh.triangles.length ? dark : color, many ? 0.25 : 0.8));
    return group;
  };

  scene.add(bodyOf(view.a, 0x0073b3, 0x00324e));
  const bodyB = bodyOf(view.b, 0xd65e00, 0x5a2500);
  bodyB.matrixAutoUpdate = false;
  scene.add(bodyB);
  const centre = new THREE.Mesh(
    new THREE.SphereBufferGeometry(1 / 110, 16, 12),
    new THREE.MeshBasicMaterial({ color: 0xffffff, depthTest: false, transparent: true }));
  centre.renderOrder = 5;
  scene.add(centre);

  // Both sides of the surface, the far one first, so that the bodies are seen through it.
  const surfaces = list.map(({ surface }) => {
    const group = new THREE.Group();
    if (!surface) return { group, planes: [] };
    const geometry = geometryOf(surface);
    for (const [side, opacity, order] of [[THREE.BackSide, 0.16, 1], [THREE.FrontSide, 0.26, 3]]) {
      const material = new THREE.MeshPhongMaterial({
        color: 0x57b5e8, side, opacity, transparent: true, depthWrite: false, shininess: 40, specular: 0x333333,
        flatShading: !surface.normals.length,
      });
      const mesh = new THREE.Mesh(geometry, material);
      mesh.renderOrder = order;
      group.add(mesh);
    }
    group.add(linesOf(surface, 0x57b5e8, surface.triangles.length > 6000 ? 0.3 : 0.8));
    // The planes of its triangles: B's centre goes along a ray from A's to the first of them.
    const p = geometry.attributes.position.array, planes = [];
    const corner = (k) => new THREE.Vector3(p[3 * k], p[3 * k + 1], p[3 * k + 2]);
    for (let t = 0; t + 2 < surface.triangles.length; t += 3) {
      const a = corner(surface.triangles[t]), b = corner(surface.triangles[t + 1]), c = corner(surface.triangles[t + 2]);
      const normal = b.clone().sub(a).cross(c.clone().sub(a));
      const longest = Math.max(a.distanceTo(b), b.distanceTo(c), c.distanceTo(a));
      if (normal.length() > 1e-3 * longest) planes.push([normal.normalize(), normal.dot(a)]);
    }
    group.visible = false;
    scene.add(group);
    return { group, planes };
  });

  const controls = new THREE.OrbitControls(camera, canvas);
  controls.enablePan = false;
  controls.enableZoom = false;

  let isAsked = false;
  const draw = () => {
    if (isAsked) return;
    isAsked = true;
    requestAnimationFrame(() => {
      isAsked = false;
      renderer.render(scene, camera);
      say("drawn");
    });
  };

  const orientation = byId("orientation"), place = byId("place"), surface = byId("surface"), play = byId("play");
  const here = byId("here");
  let shown = -1;
  const start = new THREE.Vector3(0.844, 0.39, 0.368).normalize();
  const right = new THREE.Vector3(0, 0, 1).cross(start).normalize();
  const up = start.clone().cross(right);
  const update = () => {
    const k = Math.min(list.length - 1, Number(orientation.value));
    const { planes } = surfaces[k], one = list[k];
    if (k !== shown) {
      surfaces.forEach(({ group }, j) => { group.visible = j === k; });
      here.textContent = (list.length > 1 ? `Orientation ${k + 1} of ${list.length}: ` : "This orientation: ") +
        (one.value ? `excluded volume ${one.value}` : one.surface ? "" : "no excluded volume") +
        `  (quaternion ${one.quaternion.map((q) => q.toFixed(4)).join(", ")})`;
      orientation.setAttribute("aria-valuetext", here.textContent);
      shown = k;
    }
    surfaces[k].group.visible = surface.checked;
    // Once around in the plane of the first view, leaning twice towards the eye and away.
    const angle = Number(place.value) / 180 * Math.PI;
    const dir = right.clone().multiplyScalar(Math.cos(angle)).addScaledVector(up, Math.sin(angle));
    dir.addScaledVector(start, 0.45 * Math.sin(2 * angle)).normalize();
    let distance = planes.length ? Infinity : 0.6;
    for (const [normal, offset] of planes) {
      const slope = normal.dot(dir);
      if (slope > 1e-9) distance = Math.min(distance, offset / slope);
    }
    const r = one.rotation, at = dir.multiplyScalar(distance);
    bodyB.matrix.set(r[0], r[1], r[2], at.x, r[3], r[4], r[5], at.y, r[6], r[7], r[8], at.z, 0, 0, 0, 1);
    bodyB.matrixWorldNeedsUpdate = true;
    centre.position.copy(at);
    draw();
  };

  const fit = () => {
    const width = stage.clientWidth, height = stage.clientHeight;
    if (!width || !height) return;
    renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    renderer.setSize(width, height);
    const half = Math.tan(camera.fov / 360 * Math.PI) * Math.min(1, width / height);
    const far = 0.66 / Math.sin(Math.atan(half));
    const dir = camera.position.lengthSq() ? camera.position.clone().normalize() : start;
    camera.position.copy(dir.clone().multiplyScalar(far));
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    controls.update();
    draw();
  };

  canvas.addEventListener("keydown", (event) => {
    const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const turn = turns[event.key];
    if (!turn) return;
    event.preventDefault();
    const z = camera.position.z, flat = Math.hypot(camera.position.x, camera.position.y);
    const far = camera.position.length(), azimuth = Math.atan2(camera.position.y, camera.position.x) + 0.1 * turn[0];
    const polar = Math.min(3.1, Math.max(0.04, Math.atan2(flat, z) + 0.1 * turn[1]));
    camera.position.set(far * Math.sin(polar) * Math.cos(azimuth), far * Math.sin(polar) * Math.sin(azimuth),
      far * Math.cos(polar));
    controls.update();
    draw();
  });

  let isPlaying = false;
  const step = () => {
    if (!isPlaying) return;
    place.value = String((Number(place.value) + 0.8) % 360);
    update();
    requestAnimationFrame(step);
  };
  play.addEventListener("click", () => {
    isPlaying = !isPlaying;
    play.textContent = isPlaying ? "Stop" : "Move B around A";
    if (isPlaying) requestAnimationFrame(step);
  });
  for (const input of [orientation, place, surface]) input.addEventListener("input", update);
  controls.addEventListener("change", draw);
  new ResizeObserver(fit).observe(stage);
  byId("controls").hidden = false;
  byId("pair").classList.add("drawn");
  fit();
  update();
})();
