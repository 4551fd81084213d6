import type { WebGLRenderer } from "three";

/** A frame that takes longer is drawn at half the resolution while more are to come. */
const SLOW_MS = 100;

export interface Picture {
    render(): void;
    /** The GPU has drawn what render() asked for, and no frame waits. */
    drawn(): void;
    /** Whether more frames are to come. */
    changing(): boolean;
}

/** Draws when it is asked to, and never while the GPU has a frame left: what changes meanwhile is one frame. */
export class Frames {
    private drawing = false;
    private again = false;
    private slow = true;
    private coarse = false;

    constructor(private readonly renderer: WebGLRenderer, private readonly picture: Picture) {}

    get idle(): boolean {
        return !this.drawing;
    }

    ask(): void {
        this.again = this.drawing;
        if (this.drawing) return;
        this.drawing = true;
        requestAnimationFrame(() => this.draw());
    }

    /** Asks for the frame that a coarse one stood for, when all has changed that will. */
    sharpen(): void {
        if (this.coarse && !this.picture.changing()) this.ask();
    }

    private draw(): void {
        this.again = false;
        this.coarse = this.slow && this.picture.changing();
        const ratio = Math.min(devicePixelRatio, 2) * (this.coarse ? 0.5 : 1);
        if (ratio !== this.renderer.getPixelRatio()) this.renderer.setPixelRatio(ratio);
        const begun = performance.now();
        const gl = this.renderer.getContext() as WebGL2RenderingContext;
        if (!gl.isContextLost()) this.picture.render();
        const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
        gl.flush();
        const poll = () => {
            if (fence && gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.UNSIGNALED) setTimeout(poll, 1);
            else this.finish(performance.now() - begun);
        };
        setTimeout(poll);
    }

    private finish(milliseconds: number): void {
        this.drawing = false;
        this.slow = milliseconds > (this.coarse ? SLOW_MS / 4 : SLOW_MS);
        if (this.again) return this.ask();
        this.picture.drawn();
    }
}
