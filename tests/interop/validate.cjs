// Every GLB of a folder through the Khronos glTF validator: no errors, no warnings.
const fs = require('fs');
const path = require('path');
const validator = require('gltf-validator');

async function main(folder) {
    let failed = 0;
    const files = fs.readdirSync(folder).filter((f) => f.endsWith('.glb') && !f.startsWith('broken_')).sort();
    for (const file of files) {
        const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(path.join(folder, file))));
        const { numErrors, numWarnings, numInfos, messages } = report.issues;
        const good = numErrors === 0 && numWarnings === 0;
        failed += good ? 0 : 1;
        console.log(`${good ? 'ok  ' : 'FAIL'} ${file}: Khronos: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} remarks`);
        messages.slice(0, 8).forEach((m) => console.log(`       ${m.code} ${m.pointer}: ${m.message}`));
    }
    return failed;
}

main(process.argv[2]).then((failed) => process.exit(failed ? 1 : 0));
