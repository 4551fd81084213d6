// What a visitor does in the foil studio, on a phone: before page_driver.js, whose functions it takes.
let offered; // the last card that the page gave to save
const objectUrl = URL.createObjectURL;
URL.createObjectURL = (blob) => {
    if (blob.type === "model/gltf-binary") offered = blob;
    return objectUrl(blob);
};
let copied = "";
navigator.clipboard.writeText = async (text) => void (copied = text);
let orientations = 0;
addEventListener("deviceorientation", ({ beta }) => (orientations += beta === null ? 0 : 1));

const base64 = (blob) => new Promise((resolve) => {
    const reader = Object.assign(new FileReader(), { onload: () => resolve(reader.result.split(",")[1]) });
    reader.readAsDataURL(blob);
});
const studio = () => document.getElementById("studio");
const tilt = () => JSON.parse(document.documentElement.dataset.tilt);
/** The card of what was asked for is shown, with its light. */
async function made() {
    await wait(50); // the page asks for the full card in a task of its own
    await until("the card", () => studio().dataset.busy === "false");
}

/** With a window in its ink, where the foil shows. */
async function artwork() {
    const canvas = new OffscreenCanvas(126, 176);
    const context = canvas.getContext("2d");
    for (let row = 0; row < 176; ++row) {
        context.fillStyle = `rgb(${row} 40 ${175 - row})`;
        context.fillRect(0, row, 126, 1);
    }
    context.clearRect(20, 20, 86, 110);
    return new File([await canvas.convertToBlob({ type: "image/png" })], "mine.png", { type: "image/png" });
}

function drop(file) {
    const dropped = new DataTransfer();
    dropped.items.add(file);
    dispatchEvent(new DragEvent("drop", { dataTransfer: dropped }));
}

const changedPart = (a, b) => [...a.data.keys()].filter((i) => Math.abs(a.data[i] - b.data[i]) > 8).length / a.data.length;

async function copiedLink() {
    copied = "";
    document.getElementById("copy-link").click();
    await until("the link", () => copied !== "");
    return copied;
}

/** Foil in the lower half alone. */
async function mask() {
    const canvas = new OffscreenCanvas(63, 88);
    const context = canvas.getContext("2d");
    context.fillRect(0, 0, 63, 88);
    context.fillStyle = "white";
    context.fillRect(0, 44, 63, 44);
    return new File([await canvas.convertToBlob({ type: "image/png" })], "mask.png", { type: "image/png" });
}

/** A visit by a link with an artwork in it, whose foil gets a mask and loses it. */
async function foilLinkVisit(pictures) {
    await until("the first card", () => studio()?.dataset.busy === "false");
    await until("the thumbnails", () => studio().dataset.thumbnails === "true");
    await settled();
    const chosen = document.querySelector("#studio input[name=artwork]:checked");
    const opened = { artwork: chosen.value, label: chosen.parentElement.textContent, type: document.querySelector("#studio input[name=foil]:checked").value,
        withArt: document.getElementById("with-art").checked, said: said() };
    pictures.opened = await picture();
    const link = await copiedLink();

    const remove = document.getElementById("remove-mask");
    const shown = [getComputedStyle(remove).display !== "none"];
    const files = new DataTransfer();
    files.items.add(await mask());
    const input = document.getElementById("foil-mask");
    input.files = files.files;
    input.dispatchEvent(new Event("change"));
    await until("the button that removes the mask", () => !remove.hidden);
    await made();
    pictures.masked = await picture();
    shown.push(getComputedStyle(remove).display !== "none");
    remove.click();
    await made();
    pictures.unmasked = await picture();
    shown.push(getComputedStyle(remove).display !== "none");
    return { opened, link, shown, focused: document.activeElement.id,
        changed: { by: changedPart(pictures.opened, pictures.masked), back: changedPart(pictures.opened, pictures.unmasked) } };
}

async function foilVisit(pictures) {
    const times = {};
    const mark = (name) => (times[name] = Math.round(performance.now() / 1000));
    await until("the first card", () => studio()?.dataset.busy === "false");
    await until("the thumbnails", () => studio().dataset.thumbnails === "true");
    mark("thumbnails");
    await settled();
    const before = frames();
    await wait(2000);
    const framesAtRest = frames() - before;
    mark("rest");

    const art = await artwork();
    drop(art);
    await until("the artwork's button", () => document.getElementById("artwork-mine.png"));
    await made();
    pictures.ice = await picture();
    mark("artwork");
    document.getElementById("type-hexagons").click();
    await made();
    pictures.hexagons = await picture();
    mark("type");

    const [x, y] = spot(0, 0);
    const held = tilt();
    await swipe([[[x, y], [x + 20, y + 10]]]);
    const dragged = tilt();
    await devtools("DeviceOrientation.setDeviceOrientationOverride", { alpha: 0, beta: 40, gamma: 0 });
    await until("the phone's orientation", () => orientations > 0);
    const neutral = tilt();
    pictures.dragged = await picture();
    mark("drag");
    await devtools("DeviceOrientation.setDeviceOrientationOverride", { alpha: 0, beta: 52, gamma: -6 });
    await until("another tilt", () => String(tilt()) !== String(neutral));
    const tilted = tilt();
    pictures.tilted = await picture();
    mark("tilt");

    const link = await copiedLink();
    document.getElementById("with-art").click();
    const linkWithArt = await copiedLink();
    document.getElementById("download").click();
    await until("the file", () => offered);
    const glb = await base64(offered);
    drop(new File(["no picture"], "broken.png", { type: "image/png" }));
    await until("word of the broken file", () => said() !== "");
    const found = { layout: layout(), violations: await violations() };
    mark("file");
    await devtools("DeviceOrientation.clearDeviceOrientationOverride", {});
    return {
        ...found, times, framesAtRest, tilts: { held, dragged, neutral, tilted }, link, linkWithArt, glb, art: await base64(art), broken: said(),
        changed: { type: changedPart(pictures.ice, pictures.hexagons), tilt: changedPart(pictures.dragged, pictures.tilted) },
    };
}
