// Builds the extension: node build.mjs [FILE.vsix]
//
// Bundles extension.js into dist/, and packs everything into a .vsix, which is a zip with two files of Microsoft's packaging format.
// The same sources give the same bytes.

import { mkdir, readFile, writeFile } from "node:fs/promises";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { zip } from "./zip.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const manifest = JSON.parse(await readFile(join(here, "package.json"), "utf8"));

/** Bundles the extension, and returns the folders of the packages in it. */
async function bundle() {
  const result = await build({
    absWorkingDir: here,
    entryPoints: ["extension.js"],
    outfile: "dist/extension.js",
    bundle: true,
    minify: true,
    platform: "node",
    // VS Code 1.91 has Node 20.
    target: "node20",
    format: "cjs",
    external: ["vscode"],
    legalComments: "none",
    metafile: true,
  });
  const packages = Object.keys(result.metafile.inputs).map((path) => /^node_modules\/((?:@[^/]+\/)?[^/]+)/.exec(path)?.[1]);
  return [...new Set(packages.filter(Boolean))].sort();
}

/** The licence of a package. */
async function licence(name) {
  const folder = join(here, "node_modules", name);
  const { version } = JSON.parse(await readFile(join(folder, "package.json"), "utf8"));
  for (const file of ["LICENSE", "LICENSE.md", "LICENSE.txt", "License.txt", "LICENSE-MIT"]) {
    const text = await readFile(join(folder, file), "utf8").catch(() => undefined);
    if (text !== undefined) {
      return `${name} ${version}\n\n${text.replaceAll("\r\n", "\n").trim()}\n`;
    }
  }
  throw new Error(`${relative(here, folder)} has no licence file`);
}

const escaped = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll('"', "&quot;");

const vsixManifest = () => `<?xml version="1.0" encoding="utf-8"?>
<PackageManifest Version="2.0.0" xmlns="http://schemas.microsoft.com/developer/vsx-schema/2011">
  <Metadata>
    <Identity Language="en-US" Id="${manifest.name}" Version="${manifest.version}" Publisher="${manifest.publisher}" />
    <DisplayName>${escaped(manifest.displayName)}</DisplayName>
    <Description xml:space="preserve">${escaped(manifest.description)}</Description>
    <Tags>${escaped(manifest.keywords.join(","))}</Tags>
    <Categories>${escaped(manifest.categories.join(","))}</Categories>
    <GalleryFlags>Public</GalleryFlags>
    <Properties>
      <Property Id="Microsoft.VisualStudio.Code.Engine" Value="${escaped(manifest.engines.vscode)}" />
      <Property Id="Microsoft.VisualStudio.Code.ExtensionDependencies" Value="" />
      <Property Id="Microsoft.VisualStudio.Code.ExtensionPack" Value="" />
      <Property Id="Microsoft.VisualStudio.Code.ExtensionKind" Value="${manifest.extensionKind.join(",")}" />
      <Property Id="Microsoft.VisualStudio.Code.LocalizedLanguages" Value="" />
    </Properties>
    <License>extension/LICENSE.txt</License>
  </Metadata>
  <Installation>
    <InstallationTarget Id="Microsoft.VisualStudio.Code" />
  </Installation>
  <Dependencies />
  <Assets>
    <Asset Type="Microsoft.VisualStudio.Code.Manifest" Path="extension/package.json" Addressable="true" />
    <Asset Type="Microsoft.VisualStudio.Services.Content.Details" Path="extension/readme.md" Addressable="true" />
    <Asset Type="Microsoft.VisualStudio.Services.Content.License" Path="extension/LICENSE.txt" Addressable="true" />
  </Assets>
</PackageManifest>
`;

const contentTypes = () => {
  const types = { json: "application/json", js: "application/javascript", md: "text/markdown", txt: "text/plain", vsixmanifest: "text/xml" };
  const defaults = Object.entries(types).map(([end, type]) => `<Default Extension=".${end}" ContentType="${type}" />`);
  return `<?xml version="1.0" encoding="utf-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">${defaults.join("")}</Types>
`;
};

/** Builds the package; returns its bytes. */
export async function vsix() {
  const packages = await bundle();
  const text = (path) => readFile(join(here, path), "utf8");
  const [mit, apache] = await Promise.all([text("../../LICENSE-MIT"), text("../../LICENSE-APACHE")]);
  const notices = await Promise.all(packages.map(licence));
  return zip([
    ["[Content_Types].xml", contentTypes()],
    ["extension.vsixmanifest", vsixManifest()],
    ["extension/LICENSE.txt", `${mit}\n\n${apache}`],
    ["extension/ThirdPartyNotices.txt", notices.join("\n----\n\n")],
    ["extension/dist/extension.js", await text("dist/extension.js")],
    ["extension/language-configuration.json", await text("language-configuration.json")],
    ["extension/package.json", await text("package.json")],
    ["extension/readme.md", await text("README.md")],
  ]);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const output = process.argv[2] ?? join(here, "dist", `${manifest.name}-${manifest.version}.vsix`);
  const bytes = await vsix();
  await mkdir(dirname(output), { recursive: true });
  await writeFile(output, bytes);
  console.log(`${output}: ${bytes.length} bytes`);
}
