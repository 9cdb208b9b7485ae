// Judges answers by the served OpenAPI document.
import Ajv2020 from 'ajv/dist/2020.js';
import addFormats from 'ajv-formats';

export class Contract {
  constructor(document) {
    this.document = document;
    this.ajv = new Ajv2020({ strict: false, allErrors: false });
    addFormats(this.ajv);
    this.ajv.addSchema(document, 'openapi');
  }

  static async of(url) {
    return new Contract(await (await fetch(`${url}/openapi.json`)).json());
  }

  // What is wrong with an answer; empty when nothing is. `body` is text; only JSON is looked into.
  faults({ path, method, status, type, body }) {
    const operation = this.document.paths[path]?.[method.toLowerCase()];
    if (!operation) return [`${method} ${path} is not described`];
    let place = `/paths/${escaped(path)}/${method.toLowerCase()}/responses/${status}`;
    let response = operation.responses[status];
    if (!response) return [`${method} ${path} is not described to answer ${status}`];
    if (response.$ref) {
      place = response.$ref.slice(1);
      response = at(this.document, place);
    }
    const kind = type.split(';')[0].trim();
    if (!response.content?.[kind]) return [`${method} ${path} is not described to answer ${status} with ${kind}`];
    if (!/[/+]json$/.test(kind) || kind.startsWith('model/') || !response.content[kind].schema) return [];
    const validate = this.ajv.getSchema(`openapi#${place}/content/${escaped(kind)}/schema`);
    return validate(JSON.parse(body)) ? [] : validate.errors.map((e) => `${e.instancePath}: ${e.message} ${JSON.stringify(e.params)}`);
  }
}

const escaped = (step) => step.replaceAll('~', '~0').replaceAll('/', '~1');
const at = (document, pointer) => pointer.split('/').slice(1)
  .reduce((node, step) => node[step.replaceAll('~1', '/').replaceAll('~0', '~')], document);
