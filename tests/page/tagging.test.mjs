/** Tags of the photo that is worked on. */

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { Server } from "./server.mjs";
import { quiet } from "./stubs.mjs";
import { tagging } from "../../annotate/static/around/tagging.js";
import { Labelling } from "../../annotate/static/labelled/labelling.js";

let server;
let labelling;
let card;
let tags;
let said;

beforeEach(async () => {
  server = new Server();
  labelling = new Labelling();
  card = null;
  tags = tagging(labelling, () => card);
  said = [];
  labelling.on("said", (what) => said.push(what));
  await labelling.load();
});

test("a digit puts a tag on the photo that is worked on, and takes it off", async () => {
  labelling.legend.tags = ["no visible skyline", "fog"];
  card = labelling.photos[1];
  tags.tick(2);
  await quiet();
  assert.deepEqual([server.documents.get(2).tags, said.at(-1).text], [["fog"], "hill-2.png has the tag “fog”."]);
  card = labelling.photos[1];
  tags.tick(2);
  await quiet();
  assert.deepEqual([server.documents.get(2).tags, said.at(-1).text], [[], "hill-2.png has the tag “fog” no more."]);
  tags.tick(3);
  await quiet();
  assert.deepEqual(server.documents.get(2).tags, []);
});

test("without a photo nothing is tagged", () => {
  labelling.legend.tags = ["fog"];
  tags.tick(1);
  assert.deepEqual([said, labelling.waiting], [[], 0]);
});
