/** A worker of the tasks, and the calls that wait for it. */
export class TaskWorker {
    private readonly waiting = new Map<number, { resolve: (result: never) => void; reject: (error: Error) => void }>();
    private next = 1;

    /** `onIdle`: called when no call is pending and the last result has led to no other call. */
    constructor(private readonly worker: Worker, onIdle: () => void) {
        worker.onmessage = ({ data }) => {
            const waiting = this.waiting.get(data.id);
            this.waiting.delete(data.id);
            if (data.error === undefined) waiting?.resolve(data.result as never);
            else waiting?.reject(new Error(data.error));
            if (!this.busy) setTimeout(() => this.busy || onIdle());
        };
        worker.onerror = (event) => {
            const error = new Error(event.message || "a worker of Rowland did not start");
            for (const waiting of this.waiting.values()) waiting.reject(error);
            this.waiting.clear();
        };
    }

    run<Result>(task: string, args: unknown[], transfer: Float32Array[] = []): Promise<Result> {
        const id = this.next++;
        return new Promise<Result>((resolve, reject) => {
            this.waiting.set(id, { resolve: resolve as (result: never) => void, reject });
            this.worker.postMessage({ id, task, args }, transfer.map(({ buffer }) => buffer as ArrayBuffer));
        });
    }

    /** Whether it has tasks left. */
    get busy(): boolean {
        return this.waiting.size > 0;
    }

    dispose(): void {
        this.worker.terminate();
    }
}
