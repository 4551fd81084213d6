// In a frame, before an app's script: its picture once the workers have given the last map of its light, or its errors.
addEventListener("unhandledrejection", (event) => errors.push(String(event.reason)));
addEventListener("securitypolicyviolation", (event) => errors.push(`${event.violatedDirective} forbids ${event.blockedURI}`));
console.error = (...words) => errors.push(words.join(" "));

let lit = false; // by the sharp lights as well
let settled = false;
const StartedWorker = Worker;
window.Worker = class extends StartedWorker {
    #tasks = new Map();
    constructor(...given) {
        super(...given);
        super.addEventListener("message", ({ data: { id } }) => {
            const { task, args, wasLit } = this.#tasks.get(id);
            if (task === "useKeyLights") lit = true;
            if (wasLit && args.includes("full")) settled = true;
        });
    }
    postMessage(message, ...transfer) {
        this.#tasks.set(message.id, { ...message, wasLit: lit });
        super.postMessage(message, ...transfer);
    }
};

// Until the picture is settled there are few frames: software draws each for as long as a worker needs for a part of a map.
const nextFrame = requestAnimationFrame;
let asked = [];
window.requestAnimationFrame = (draw) => {
    asked.push(draw);
    return -1;
};
function frame(now) {
    const draws = asked;
    asked = [];
    for (const draw of draws) draw(now);
    setTimeout(() => nextFrame(frame), settled ? 0 : 400);
}
nextFrame(frame);

let framesAfter = 0;
function watch() {
    if (settled) framesAfter += 1;
    if (framesAfter < 3 && errors.length === 0) return requestAnimationFrame(watch);
    const canvas = document.querySelector("canvas");
    const pixels = canvas ? [...pixelsOf(canvas, canvas.width, canvas.height)] : [];
    parent.postMessage({ errors, pixels, colour: colourOf(pixels), url: canvas?.toDataURL("image/png") }, "*");
}
requestAnimationFrame(watch);
