// SPDX-License-Identifier: GPL-3.0-or-later
// node ajv.js SCHEMA <DOCUMENTS: a list of documents as JSON; prints a list of what ajv says of each: null or an error.
// Without ajv it ends with 77.
const fs = require("fs");
let Ajv;
try {
    Ajv = require("ajv");
} catch {
    process.exit(77);
}
const ajv = new Ajv();
const schema = JSON.parse(fs.readFileSync(process.argv[2], "utf8"));
if (!ajv.validateSchema(schema)) throw new Error(ajv.errorsText());
const validate = ajv.compile(schema);
const documents = JSON.parse(fs.readFileSync(0, "utf8"));
console.log(JSON.stringify(documents.map((document) => (validate(document) ? null : ajv.errorsText(validate.errors)))));
