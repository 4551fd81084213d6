// node validate_gltf.cjs FILE: runs Khronos' validator (npm gltf-validator) on a file. Exit status: 0 no errors, 1 errors
// or warnings, which are printed, 77 no validator. ROWLAND_GLTF_VALIDATOR may name the module's folder.
const fs = require('fs');

function find_validator() {
    for (const name of [process.env.ROWLAND_GLTF_VALIDATOR, 'gltf-validator'])
        if (name)
            try {
                return require(name);
            } catch (error) {
                if (error.code !== 'MODULE_NOT_FOUND') throw error;
            }
    process.exit(77);
}

find_validator()
    .validateBytes(new Uint8Array(fs.readFileSync(process.argv[2])), {maxIssues: 0})
    .then((report) => {
        const kMostSevere = 1;  // 0: error, 1: warning, 2: information, 3: hint
        const broken = report.issues.messages.filter((message) => message.severity <= kMostSevere);
        for (const message of broken) console.log(`${message.code} at ${message.pointer}: ${message.message}`);
        process.exit(report.issues.numErrors + report.issues.numWarnings > 0 ? 1 : 0);
    })
    .catch((error) => {
        console.log(String(error));
        process.exit(1);
    });
