// Before the README's script: its picture, as soon as that has colours.
addEventListener("unhandledrejection", (event) => errors.push(String(event.reason)));
console.error = (...words) => errors.push(words.join(" "));

const COLOURFUL = 3; // a disc without grooves is grey
function watch() {
    const canvas = document.querySelector("canvas");
    const colour = canvas ? colourOf(pixelsOf(canvas, 160, 90)) : 0;
    if (colour < COLOURFUL && errors.length === 0) return requestAnimationFrame(watch);
    fetch("/result", { method: "POST", body: JSON.stringify({ errors, colour, url: canvas?.toDataURL("image/png") ?? "," }) });
}
requestAnimationFrame(watch);
