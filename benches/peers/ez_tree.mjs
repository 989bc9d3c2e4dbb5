// Milliseconds of processor time and triangles of trees made by ez-tree, one JSON object a line.
//
// Node has no pictures to load; the library asks for bark and leaf textures when it is loaded, so stubs stand in for the
// browser. Only Tree.generate() is measured, which makes the meshes of wood and leaves.

const element = () => ({ style: {}, setAttribute() {}, addEventListener() {}, removeEventListener() {} });
globalThis.document = { createElementNS: element, createElement: element };
globalThis.self = globalThis;

const { Tree, TreePreset } = await import("@dgreenheck/ez-tree");

const ROUNDS = Number(process.env.ROUNDS ?? 30);

function triangles(mesh) {
    return mesh.geometry.index.count / 3;
}

for (const name of Object.keys(TreePreset)) {
    const tree = new Tree();
    tree.loadPreset(name);
    const times = [];
    for (let round = 0; round < ROUNDS; round++) {
        const before = process.cpuUsage();
        tree.generate();
        const used = process.cpuUsage(before);
        times.push((used.user + used.system) / 1000);
    }
    times.sort((a, b) => a - b);
    const count = triangles(tree.branchesMesh) + triangles(tree.leavesMesh);
    console.log(JSON.stringify({ tree: name, triangles: count, cpu_ms: times[times.length >> 1] }));
}
