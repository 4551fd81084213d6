/** A WebAssembly module of the bake: content/web/bake. */

type Export = (...numbers: number[]) => number;

export class BakeModule {
    private constructor(
        private readonly exports: WebAssembly.Exports,
        private readonly memory: WebAssembly.Memory,
    ) {}

    static async load(bytes: BufferSource | WebAssembly.Module): Promise<BakeModule> {
        let memory: WebAssembly.Memory;
        const textAt = (begin: number, length: number) => new TextDecoder().decode(new Uint8Array(memory.buffer, begin, length));
        const worker: Record<string, (a: number, b: number) => number> = {
            refused: (message) => {
                throw new Error(textAt(message, new Uint8Array(memory.buffer).indexOf(0, message) - message));
            },
            number: (begin, length) => Number(textAt(begin, length)),
            text: (number, address) =>
                new TextEncoder().encodeInto(String(Number(number.toPrecision(9))), new Uint8Array(memory.buffer, address)).written,
        };
        const module = bytes instanceof WebAssembly.Module ? bytes : await WebAssembly.compile(bytes);
        const imports: WebAssembly.Imports = {};
        for (const { module: from, name } of WebAssembly.Module.imports(module)) {
            imports[from] ??= {};
            // Other imports are system calls of the C++ library, which are never reached.
            imports[from][name] = from === "worker" ? worker[name] : from === "Math" ? (Math[name as keyof Math] as () => number) : () => 0;
        }
        const instance = await WebAssembly.instantiate(module, imports);
        memory = instance.exports.memory as WebAssembly.Memory;
        (instance.exports._initialize as (() => void) | undefined)?.();
        return new BakeModule(instance.exports, memory);
    }

    call(name: string, ...numbers: number[]): number {
        return (this.exports[name] as Export)(...numbers);
    }

    /** Copies bytes into the module's memory and returns their address. */
    put(bytes: Uint8Array): number {
        const address = this.call("room", bytes.length);
        new Uint8Array(this.memory.buffer).set(bytes, address);
        return address;
    }

    putFloats(floats: Float32Array): number {
        return this.put(new Uint8Array(floats.buffer, floats.byteOffset, floats.byteLength));
    }

    /** Calls an export that returns Numbers, and copies and releases them. */
    numbers(name: string, ...numbers: number[]): Float32Array {
        const list = this.call(name, ...numbers);
        const begin = this.call("numbers_begin", list);
        const copy = new Float32Array(this.memory.buffer, begin, this.call("numbers_count", list)).slice();
        this.call("release_numbers", list);
        return copy;
    }
}
