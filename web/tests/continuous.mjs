// The tests of the page that CI runs, in one process: they share a browser. `all.mjs` runs the others too.

import "./opening.test.mjs";
import "./first.test.mjs";
import "./lab.test.mjs";
import "./equation.test.mjs";
import "./lights.test.mjs";
import "./probe.test.mjs";
import "./keys.test.mjs";
import "./access.test.mjs";
import "./frame.test.mjs";
import "./files.test.mjs";
import "./parts.test.mjs";
import "./link.test.mjs";
import "./phone.test.mjs";
import "./parity.test.mjs";
import "./check.test.mjs";
import "./exercise.test.mjs";
import "./french.test.mjs";
import "./scripts.test.mjs";
import "./trouble.test.mjs";
