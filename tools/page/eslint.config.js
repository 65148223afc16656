/** Rules for the JavaScript of the labelling page, of the viewer's page, and of the tests. */

import js from "@eslint/js";
import globals from "globals";

const SENSIBLE = {
  "max-lines": ["error", { max: 250, skipComments: true, skipBlankLines: true }],
  complexity: ["error", 9],
  eqeqeq: ["error", "always"],
  "no-var": "error",
  "prefer-const": "error",
  "no-shadow": ["error", { builtinGlobals: false }],
  "no-implicit-coercion": "error",
  "no-unused-expressions": "error",
  "no-throw-literal": "error",
  "object-shorthand": "error",
  "consistent-return": "off", // tsc sees more
};

export default [
  js.configs.recommended,
  { linterOptions: { reportUnusedDisableDirectives: "error" }, rules: SENSIBLE },
  { files: ["**/static/**/*.js"], languageOptions: { globals: globals.browser } },
  {
    files: ["**/viewer_page/**/*.js"],
    languageOptions: { sourceType: "script", globals: { ...globals.browser, wasm_bindgen: "readonly" } },
  },
  { files: ["**/tests/**/*.mjs", "**/tools/**/*.js"], languageOptions: { globals: globals.node } },
  { files: ["**/tests/**/*.mjs"], rules: { complexity: "off" } }, // a model of the server has many cases
  { files: ["**/static/**/*.js"], rules: { "no-restricted-globals": ["error", "event", "name", "find"] } }, // of the window
];
