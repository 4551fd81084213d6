import type { WebGLRenderer } from "three";

/** A frame that takes longer is drawn at half the resolution while more are to come. */
const SLOW_MS = 100;

/** Resolves when the GPU has done what it was asked for. To ask it for a result before blocks the page. */
export function gpuDone(renderer: WebGLRenderer): Promise<void> {
    const gl = renderer.getContext() as WebGL2RenderingContext;
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    return new Promise((resolve) => {
        const poll = () => {
            if (fence && gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.UNSIGNALED) setTimeout(poll, 1);
            else resolve();
        };
        setTimeout(poll);
    });
}

export interface Picture {
    /** Resolves when render() would wait for nothing; the page goes on meanwhile. */
    prepare(): Promise<void>;
    render(): void;
    /** The GPU has drawn what render() asked for. */
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
        requestAnimationFrame(() => void this.draw());
    }

    /** Asks for the frame that a coarse one stood for, when all has changed that will. */
    sharpen(): void {
        if (this.coarse && !this.picture.changing()) this.ask();
    }

    private async draw(): Promise<void> {
        do {
            this.again = false;
            await this.picture.prepare();
        } while (this.again);
        this.coarse = this.slow && this.picture.changing();
        const ratio = Math.min(devicePixelRatio, 2) * (this.coarse ? 0.5 : 1);
        if (ratio !== this.renderer.getPixelRatio()) this.renderer.setPixelRatio(ratio);
        const begun = performance.now();
        if (!this.renderer.getContext().isContextLost()) this.picture.render();
        await gpuDone(this.renderer);
        this.finish(performance.now() - begun);
    }

    private finish(milliseconds: number): void {
        this.drawing = false;
        this.slow = milliseconds > (this.coarse ? SLOW_MS / 4 : SLOW_MS);
        if (this.again) this.ask();
        this.picture.drawn();
    }
}
