// Prints what the Khronos glTF validator says of each file, as one JSON object per line:
// {errors, warnings, triangles, messages}. A file that it cannot read at all is one error.
import fs from 'node:fs';
import path from 'node:path';
import validator from 'gltf-validator';

async function judge(file) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
    uri: path.basename(file),
    maxIssues: 100,
    externalResourceFunction: (uri) =>
      fs.promises.readFile(path.join(path.dirname(file), decodeURIComponent(uri)))
        .then((data) => new Uint8Array(data)),
  });
  return {
    errors: report.issues.numErrors,
    warnings: report.issues.numWarnings,
    triangles: report.info.totalTriangleCount,
    messages: report.issues.messages.filter((message) => message.severity <= 1).slice(0, 5),
  };
}

for (const file of process.argv.slice(2)) {
  const verdict = await judge(file).catch(
    (error) => ({ errors: 1, warnings: 0, triangles: 0, messages: [String(error)] }));
  console.log(JSON.stringify(verdict));
}
