// Before the page's own script, and before the driver that says what to do: errors, and how colourful a picture is.
const errors = [];
addEventListener("error", (event) => errors.push(event.message));

// So that a picture can be read at any time.
const getContext = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, settings) {
    return getContext.call(this, kind, { ...settings, preserveDrawingBuffer: true });
};

/** The picture scaled to this size: red, green, blue and alpha of each pixel. */
function pixelsOf(picture, width, height) {
    const flat = Object.assign(document.createElement("canvas"), { width, height }).getContext("2d");
    flat.drawImage(picture, 0, 0, width, height);
    return flat.getImageData(0, 0, width, height).data;
}

/** Mean difference of the largest and smallest of red, green and blue. */
function colourOf(pixels) {
    let colour = 0;
    for (let i = 0; i < pixels.length; i += 4)
        colour += Math.max(pixels[i], pixels[i + 1], pixels[i + 2]) - Math.min(pixels[i], pixels[i + 1], pixels[i + 2]);
    return colour / (pixels.length / 4);
}
