// Commands of Chrome's DevTools protocol, over the browser's pipe: JSON, each message ended by a zero byte.
export class DevTools {
    #to;
    #waiting = new Map();
    #sent = 0;
    #page;

    /** `browser`: started with --remote-debugging-pipe. */
    constructor(browser) {
        this.#to = browser.stdio[3];
        let received = "";
        browser.stdio[4].setEncoding("utf8").on("data", (text) => {
            const messages = (received + text).split("\0");
            received = messages.pop();
            for (const message of messages) this.#take(JSON.parse(message));
        });
        for (const pipe of [browser.stdio[3], browser.stdio[4]]) pipe.on("error", () => {}); // when it is killed
    }

    #take({ id, result, error }) {
        this.#waiting.get(id)?.(error ? { error } : result);
        this.#waiting.delete(id);
    }

    #send(method, params = {}, sessionId = undefined) {
        const id = ++this.#sent;
        return new Promise((resolve) => {
            this.#waiting.set(id, resolve);
            this.#to.write(JSON.stringify({ id, method, params, sessionId }) + "\0");
        });
    }

    async #attach() {
        const { targetInfos } = await this.#send("Target.getTargets");
        const { targetId } = targetInfos.find(({ type }) => type === "page");
        return (await this.#send("Target.attachToTarget", { targetId, flatten: true })).sessionId;
    }

    /** Sends a command to the page, or of the system to the browser: what it gives back. */
    async command({ method, params }) {
        if (method.startsWith("SystemInfo.")) return this.#send(method, params);
        this.#page ??= this.#attach();
        return this.#send(method, params, await this.#page);
    }
}
